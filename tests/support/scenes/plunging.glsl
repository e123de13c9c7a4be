// The section of a plunging crest. docs/formulae.md, section 17.

// @part section
// Whether a place is in the water of the section at a phase of overturning in [0, 1]. at: x along the wave's travel and z up, in the wave's
// heights. The constants are those of plunging.py.

float plunging_top(float x) {
    float behind = min(x, 0.0) / PLUNGING_LENGTH;
    float ahead = max(x, 0.0) / PLUNGING_THROW;
    float back = max(1.0 - behind * behind, 0.0);
    return back * back - (1.0 - PLUNGING_LANDS) * ahead * ahead;
}

bool plunging_water(vec2 at, float phase) {
    float tip = PLUNGING_THROW * phase;
    float hindmost = -PLUNGING_BORE * phase;
    float top = plunging_top(at.x);
    // Over its vertical place the face goes on straight up; rounding there must not make a root of less than 0.
    float up = min(at.y, PLUNGING_VERTICAL) - PLUNGING_HALF_HEIGHT;
    float square = PLUNGING_XZ * PLUNGING_XZ * up * up - PLUNGING_XX * (PLUNGING_ZZ * up * up - PLUNGING_LONG * PLUNGING_LONG);
    float arc = hindmost + PLUNGING_HALF_WIDTH - (PLUNGING_XZ * up + sqrt(max(square, 0.0))) / PLUNGING_XX;
    bool body = at.x <= arc;
    float left = clamp(1.0 - (at.x - hindmost) / max(tip - hindmost, 1e-12), 0.0, 1.0);
    float thick = (plunging_top(hindmost) - PLUNGING_VERTICAL) * (1.0 - sqrt(1.0 - left * left));
    bool jet = at.x > hindmost && at.x <= tip && at.y >= top - thick;
    return at.y <= 0.0 || (at.y <= top && (body || jet) && at.x >= -PLUNGING_LENGTH);
}
