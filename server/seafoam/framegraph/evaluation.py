"""Uniform rules in float64: compute uniforms from a plan, a time and a camera. The web client has the same rules;
``tests/golden/uniform_rules.json`` tests both."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seafoam.framegraph.rules import COMPONENTS, CameraRule, Clamp, Constant, Loop, Phase, Rule, Uniform, Viewport, Wrap
from seafoam.scene import Camera


@dataclass(frozen=True)
class FrameState:
    """Inputs of a frame: time (s), camera, size of the picture and of the pass's target (pixels)."""

    time: float
    camera: Camera
    width: int
    height: int
    target_width: int
    target_height: int


def evaluate(uniform: Uniform, state: FrameState) -> NDArray[np.float32]:
    """Return the uniform's values, flat float32. Raises ``ValueError`` if the rules do not fill it exactly."""
    values = [value for rule in uniform.rules for value in evaluate_rule(rule, state)]
    if len(values) != COMPONENTS[uniform.type] * uniform.count:
        raise ValueError(f"{len(values)} values for {uniform.count} × {uniform.type}")
    return np.array(values, np.float32)


def evaluate_rule(rule: Rule, state: FrameState) -> tuple[float, ...]:
    match rule:
        case Constant():
            return rule.value
        case Phase():
            return (math.remainder(_sum(rule, state), 2.0 * math.pi),)
        case Wrap():
            return (_modulo(_sum(rule, state), rule.period),)
        case Loop():
            time = state.time if rule.step is None else state.time - _modulo(state.time, rule.step)
            return (_modulo(time + rule.offset, rule.period),)
        case Clamp():
            return (min(max(_sum(rule, state), rule.low), rule.high),)
        case CameraRule():
            return _camera(rule, state)
        case Viewport():
            target, picture = (state.target_width, state.target_height), (state.width, state.height)
            width, height = picture if rule.of == "picture" else target
            return float(rule.times * width), float(rule.times * height)


def _sum(rule: Phase | Wrap | Clamp, state: FrameState) -> float:
    x, _, z = state.camera.position
    return rule.offset + (rule.rate or 0.0) * state.time + (rule.k[0] * x + rule.k[1] * z)


def _modulo(value: float, period: float) -> float:
    remainder = value % period
    # A tiny negative remainder plus the period is rounded to the period itself.
    return 0.0 if remainder >= period else remainder


def _camera(rule: CameraRule, state: FrameState) -> tuple[float, ...]:
    camera = state.camera
    eye = camera.position[1]
    if rule.what == "eye_height":
        return (eye,)
    right, up, forward = axes(camera)
    tangent = math.tan(0.5 * camera.fov)
    aspect = state.width / state.height
    match rule.what:
        case "ray_x":
            return tuple(tangent * aspect * value for value in right)
        case "ray_y":
            return tuple(tangent * value for value in up)
        case "ray_z":
            return forward
        case _:
            near = max(0.02, 0.5 * (eye - rule.top))
            across = tuple(value / (tangent * aspect) for value in right)
            rows = (across, tuple(value / tangent for value in up), forward, forward)
            lift = [-eye * row[1] for row in rows]
            lift[2] -= 2.0 * near
            return tuple(value for column in range(3) for value in (row[column] for row in rows)) + tuple(lift)


def axes(camera: Camera) -> tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]:
    """Return right, up and forward vectors of a camera; unit length, without a pole at any pitch."""
    sy, cy = math.sin(camera.yaw), math.cos(camera.yaw)
    sp, cp = math.sin(camera.pitch), math.cos(camera.pitch)
    sr, cr = math.sin(camera.roll), math.cos(camera.roll)
    right = (cy, 0.0, sy)
    up = (-sy * sp, cp, cy * sp)
    rolled = tuple(a * cr + b * sr for a, b in zip(right, up, strict=True))
    raised = tuple(b * cr - a * sr for a, b in zip(right, up, strict=True))
    return (rolled[0], rolled[1], rolled[2]), (raised[0], raised[1], raised[2]), (sy * cp, sp, -cy * cp)
