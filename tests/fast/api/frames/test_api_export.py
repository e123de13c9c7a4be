"""A scene to take home: the archive's contents, its bytes and its limits; and the recipe that a PNG carries."""

import base64
import hashlib
import io
import json
import re
import zipfile

import numpy as np
import pytest

from seafoam.api.export import bundle
from seafoam.api.export.bundle import slug
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.scene.presets import load_preset
from support.serving import picture

PATHS = re.compile(
    r"index\.html|README\.md|LICENSE|player\.js|snippets/three\.js|uniforms\.json|data/(plan|recipe|texture-\d\d-[a-z0-9-]+)\.js"
    r"|programs/\d\d-[a-z0-9-]+\.(vert|frag)\.glsl"
)
PRESET = "paper-halftone"


@pytest.fixture(autouse=True)
def player(monkeypatch, tmp_path):
    """A player of four short files, so that no build is needed."""
    for name in bundle.PLAYER:
        (tmp_path / name).write_text("{{title}} {{plan}}\n    <!-- data -->\n")
    (tmp_path / "snippets").mkdir()
    (tmp_path / "snippets" / "three.js").write_text("// {{title}}")
    monkeypatch.setattr(bundle, "data_dir", lambda _: tmp_path.parent)
    folder = tmp_path.parent / "export"
    if not folder.exists():
        folder.symlink_to(tmp_path)
    yield tmp_path
    folder.unlink()


def body(**changes):
    scene = load_preset(PRESET).scene.model_dump(mode="json")
    return {"scene": scene, "quality": "draft", "preset": PRESET, "time": 2.5, "width": 320, "height": 180} | changes


def exported(client, **changes):
    response = client.post("/api/export", json=body(**changes))
    assert response.status_code == 200, response.text
    return response


def files(response):
    archive = zipfile.ZipFile(io.BytesIO(response.content))
    assert archive.testzip() is None
    return archive, {name: archive.read(name) for name in archive.namelist()}


def test_the_archive_holds_the_plan_the_programs_and_the_textures(client):
    response = exported(client)
    assert response.headers["Content-Type"] == "application/zip"
    assert response.headers["Content-Disposition"] == f'attachment; filename="seafoam-{PRESET}.zip"'
    _, found = files(response)
    plan = make_plan(load_preset(PRESET).scene, TIERS["draft"])
    assert response.headers["Seafoam-Plan"] == plan.sha256
    assert found["data/plan.js"].endswith(b"seafoamData.plan = " + plan.canonical_json() + b";\n")
    for index, (name, program) in enumerate(plan.programs.items()):
        for stage, shader in (("vert", program.vertex), ("frag", program.fragment)):
            content = found[f"programs/{index:02d}-{slug(name)}.{stage}.glsl"]
            assert hashlib.sha256(content).hexdigest() == shader.sha256
    assert found["snippets/three.js"] == b"// {{title}}"
    html = found["index.html"].decode()
    assert load_preset(PRESET).title in html
    textures = [name for name in found if name.startswith("data/texture-")]
    assert len(textures) == len({spec.sha256 for spec in plan.textures.values()})
    for name in textures:
        assert f'<script src="{name}"></script>' in html
        sha256, encoded = re.search(rb'"([0-9a-f]{64})"\] =\n  "([\w+/=]+)"', found[name]).groups()
        assert hashlib.sha256(base64.b64decode(encoded)).hexdigest() == sha256.decode()


def test_the_uniforms_are_those_of_the_frame(client):
    _, found = files(exported(client))
    plan = make_plan(load_preset(PRESET).scene, TIERS["draft"])
    listed = json.loads(found["uniforms.json"])
    assert [one["pass"] for one in listed] == [one.name for one in plan.passes]
    height = load_preset(PRESET).scene.camera.position[1]
    eyes = {
        value
        for one in listed
        for name, said in one["uniforms"].items()
        if plan.uniforms.get(name) and plan.uniforms[name].rules[0].model_dump().get("what") == "eye_height"
        for value in said["values"]
    }
    assert eyes == {float(np.float32(height))}


def test_the_same_request_gives_the_same_bytes(client):
    first, again = exported(client), exported(client)
    assert first.content == again.content
    assert exported(client, time=3.0).content != first.content
    archive, found = files(first)
    assert {entry.date_time for entry in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}
    assert archive.namelist() == list(dict.fromkeys(archive.namelist())), "no name twice"
    assert len(found) == len(archive.infolist())


@pytest.mark.parametrize("preset", ["coastline", "boat-in-storm", "default"])
def test_every_path_is_a_generated_name(client, preset):
    scene = load_preset(preset).scene.model_dump(mode="json")
    archive, _ = files(exported(client, scene=scene, preset=None))
    assert all(PATHS.fullmatch(name) for name in archive.namelist()), archive.namelist()


@pytest.mark.parametrize("name", ["../../etc/passwd", "a/b", "C:\\x", "", "···"])
def test_a_name_cannot_leave_the_archive(name):
    assert re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", slug(name))


def test_too_many_bytes_are_a_problem(client, monkeypatch):
    monkeypatch.setattr(bundle, "TEXTURES_LIMIT", 1 << 10)
    response = client.post("/api/export", json=body())
    assert response.status_code == 422
    assert response.json()["type"] == "urn:seafoam:problem:export-too-large"


def test_without_a_build_the_remedy_is_named(client, player):
    (player / "player.js").unlink()
    response = client.post("/api/export", json=body())
    assert response.status_code == 501
    assert "make webclient" in response.json()["remedy"]


# The recipe


def test_a_png_carries_its_recipe_and_the_recipe_gives_the_same_bytes(client):
    request = body() | {"format": "png"}
    first = client.post("/api/frames", json=request)
    recipe = json.loads(picture(first).text["seafoam"])
    assert recipe["renderer"] == "gradient, 0"
    assert recipe["recipe"] == 1
    asked = ("scene", "quality", "time", "width", "height", "camera", "preset")
    again = client.post("/api/frames", json={name: recipe[name] for name in asked})
    assert again.content == first.content
    assert again.headers["ETag"] == first.headers["ETag"]


def test_a_frame_of_a_preset_names_it(client):
    got = client.get("/api/frames/default.png?width=24&height=16&quality=high&yaw=0.5")
    recipe = json.loads(picture(got).text["seafoam"])
    assert (recipe["preset"], recipe["quality"], recipe["camera"]["yaw"]) == ("default", "high", 0.5)
    posted = client.post(
        "/api/frames", json={name: recipe[name] for name in recipe.keys() - {"recipe", "seafoam", "renderer", "plan"}}
    )
    assert posted.content == got.content


def test_settings_of_a_quality_are_those_that_differ_from_standard(client):
    got = client.post("/api/frames", json=body(quality={"samples": 4, "surface": {"steps": 99}}))
    recipe = json.loads(picture(got).text["seafoam"])
    assert recipe["quality"] == {"samples": 4, "surface": {"steps": 99}}


def test_frames_that_differ_in_their_recipe_alone_have_their_own_tags(client):
    named, unnamed = client.post("/api/frames", json=body()), client.post("/api/frames", json=body(preset=None))
    assert named.headers["ETag"] != unnamed.headers["ETag"]
    assert named.content != unnamed.content
