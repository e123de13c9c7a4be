"""The cost of accuracy over HTTP: 202 until it is measured, then every form of it, and quality=auto from it."""

import io
import time

import numpy as np
import pytest

from seafoam.quality import TIERS
from seafoam.scene import load_preset
from support.serving import problem, serving

PRESET = "paper-threshold"
URL = f"/api/accuracy/{PRESET}"
SMALL = {"accuracy_width": 32, "accuracy_height": 18, "accuracy_samples": 2, "accuracy_rounds": 2}
FRAME = {"width": 24, "height": 16}
AUTO = {"quality": "auto", "budget_ms": 8, **FRAME}


def eventually(ask, seconds=60.0):
    """The answers until one is neither 202 nor 503."""
    until = time.monotonic() + seconds
    answers = [ask()]
    while answers[-1].status_code in (202, 503):
        assert int(answers[-1].headers["Retry-After"]) >= 1
        assert answers[-1].headers["Cache-Control"] == "no-store"
        assert time.monotonic() < until, answers[-1].text
        time.sleep(0.1)
        answers.append(ask())
    return answers


@pytest.fixture(scope="module")
def fresh(tmp_path_factory):
    """An app that has measured nothing yet."""
    with serving(cache=tmp_path_factory.mktemp("cache"), **SMALL) as client:
        yield client


def test_measured_on_request(fresh, described):
    early = problem(fresh.get(f"/api/frames/{PRESET}.png", params=AUTO), 503)
    assert early["type"] == "urn:seafoam:problem:not-measured"
    assert "measure" in early["detail"]
    first, *_, last = eventually(lambda: fresh.get(URL))
    assert (first.status_code, last.status_code) == (202, 200), last.text
    for each in (first, last):
        described("/api/accuracy/{preset}", each)
    found = last.json()
    assert found["preset"] == PRESET
    assert found["machine"]["renderer"] == "gradient"
    # The preset is level water without ripples, where a fast is the standard.
    assert {point["id"] for point in found["points"]} >= set(TIERS) - {"fast"}
    assert set(found["front"]) <= {point["id"] for point in found["points"]}
    assert fresh.get(URL, headers={"If-None-Match": last.headers["ETag"]}).status_code == 304
    points = fresh.get(f"{URL}/points").json()
    assert [point["id"] for point in points["points"]] == [point["id"] for point in found["points"]]
    assert points["truth"] == found["truth"]


def test_every_form_of_it(fresh):
    eventually(lambda: fresh.get(URL))
    table = fresh.get(f"{URL}.csv")
    assert table.headers["Content-Type"].startswith("text/csv")
    assert table.text.startswith("id,tier")
    assert fresh.get(f"{URL}.png").content.startswith(b"\x89PNG")
    truth = np.load(io.BytesIO(fresh.get(f"{URL}/truth.npy").content), allow_pickle=False)
    assert (truth.shape, truth.dtype) == ((18, 32, 4), np.dtype("<f4"))
    assert truth[..., 3].max() > 0.0


def test_auto_says_what_it_took_and_why_and_measures_a_changed_preset_by_itself(fresh, monkeypatch):
    eventually(lambda: fresh.get(URL))
    response = fresh.get(f"/api/frames/{PRESET}.png", params=AUTO)
    assert response.status_code == 200, response.text
    ids = {point["id"]: point for point in fresh.get(URL).json()["points"]}
    chosen = ids[response.headers["Seafoam-Quality"]]
    assert response.headers["Seafoam-Plan"] == chosen["plan"]
    assert "of 8 ms at 24 x 16" in response.headers["Seafoam-Quality-Why"]
    assert f"of {len(ids)} measured" in response.headers["Seafoam-Quality-Why"]
    hurried = fresh.get(f"/api/frames/{PRESET}.png", params=AUTO | {"budget_ms": 1e-3})
    assert "none within budget" in hurried.headers["Seafoam-Quality-Why"]
    scene = load_preset(PRESET).scene.model_dump(mode="json")
    posted = fresh.post("/api/frames", json={"scene": scene, **AUTO})
    assert posted.headers["Seafoam-Quality"] == response.headers["Seafoam-Quality"]
    assert "Seafoam-Quality" not in fresh.get(f"/api/frames/{PRESET}.png", params=FRAME).headers
    monkeypatch.setattr("seafoam.accuracy.sweep_service.make_sweep", lambda *_: None)  # it would take as long again
    assert fresh.get(f"/api/frames/{PRESET}.png", params=AUTO | {"mask": "vac-6"}).status_code == 503


def test_auto_and_its_budget_come_together_with_what_can_be_drawn(fresh):
    scene = load_preset(PRESET).scene.model_dump(mode="json")
    for given in ({"quality": "auto"}, {"budget_ms": 8}, {"quality": "auto", "budget_ms": 0}):
        got = fresh.get(f"/api/frames/{PRESET}.png", params=FRAME | given)
        posted = fresh.post("/api/frames", json={"scene": scene, **FRAME, **given})
        assert problem(got, 422)["errors"][0]["parameter"] == "budget_ms"
        assert problem(posted, 422)["errors"][0]["pointer"] == "/budget_ms"
    assert fresh.get(f"/api/plans/{PRESET}", params={"quality": "auto"}).status_code == 422
    for name, value in (("mask", "nobody-has"), ("width", 10**6)):
        refused = fresh.get(f"/api/frames/{PRESET}.png", params=AUTO | {name: value})
        assert problem(refused, 422)["errors"][0]["parameter"] == name


def test_a_server_keeps_what_is_finished_and_stops_in_the_middle_of_a_measurement(fresh, tmp_path):
    eventually(lambda: fresh.get(URL))
    kept = fresh.app.state.context.settings.cache
    assert len(list((kept / "accuracy").glob("*/*"))) == 2, "a sweep and its truth"
    with serving(cache=tmp_path, **SMALL | {"accuracy_width": 640, "accuracy_samples": 32}) as client:
        assert client.get(f"{URL}/truth.npy").status_code == 202
        assert client.get(URL).status_code == 202
        time.sleep(0.5)
    assert not (tmp_path / "accuracy").exists(), "it waited for the measurement"
