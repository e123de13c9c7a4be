"""A scene to take home: the archive's contents and its bytes."""

import base64
import hashlib
import io
import json
import re
import zipfile

import numpy as np
import pytest

from seafoam.api.routers import export
from seafoam.api.routers.export import slug
from seafoam.planner import make_plan
from seafoam.quality import TIERS
from seafoam.scene import load_preset
from support.serving import problem

PATHS = re.compile(
    r"index\.html|README\.md|LICENSE|player\.js|snippets/three\.js|uniforms\.json|data/(plan|recipe|texture-\d\d-[a-z0-9-]+)\.js"
    r"|programs/\d\d-[a-z0-9-]+\.(vert|frag)\.glsl"
)
PRESET = "paper-halftone"


@pytest.fixture(autouse=True)
def player(monkeypatch, tmp_path):
    """A player of four short files, so that no build is needed."""
    folder = tmp_path / "export"
    (folder / "snippets").mkdir(parents=True)
    for name in export.PLAYER:
        (folder / name).write_text("{{title}} {{plan}}\n    <!-- data -->\n")
    (folder / "snippets" / "three.js").write_text("// {{title}}")
    monkeypatch.setattr(export, "data_dir", lambda _: tmp_path)
    return folder


def body(**changes):
    scene = load_preset(PRESET).scene.model_dump(mode="json")
    return {"scene": scene, "quality": "fast", "preset": PRESET, "time": 2.5, "width": 320, "height": 180} | changes


def exported(client, **changes):
    """The answer, its archive, and the contents of its files."""
    response = client.post("/api/export", json=body(**changes))
    assert response.status_code == 200, response.text
    archive = zipfile.ZipFile(io.BytesIO(response.content))
    assert archive.testzip() is None
    return response, archive, {name: archive.read(name) for name in archive.namelist()}


def test_the_archive_holds_the_plan_the_programs_and_the_textures(client):
    response, _, found = exported(client)
    assert response.headers["Content-Type"] == "application/zip"
    assert response.headers["Content-Disposition"] == f'attachment; filename="seafoam-{PRESET}.zip"'
    plan = make_plan(load_preset(PRESET).scene, TIERS["fast"])
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
    found = exported(client)[2]
    plan = make_plan(load_preset(PRESET).scene, TIERS["fast"])
    listed = json.loads(found["uniforms.json"])
    assert [one["pass"] for one in listed] == [one.name for one in plan.passes]
    eyes = {
        value
        for one in listed
        for name, said in one["uniforms"].items()
        if plan.uniforms.get(name) and plan.uniforms[name].rules[0].model_dump().get("what") == "eye_height"
        for value in said["values"]
    }
    assert eyes == {float(np.float32(load_preset(PRESET).scene.camera.position[1]))}


def test_the_same_request_gives_the_same_bytes(client):
    first, archive, found = exported(client)
    assert exported(client)[0].content == first.content
    assert exported(client, time=3.0)[0].content != first.content
    assert {entry.date_time for entry in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}
    assert len(found) == len(archive.infolist()), "no name twice"


def test_every_path_is_a_generated_name_that_cannot_leave_the_archive(client):
    assert all(PATHS.fullmatch(name) for name in exported(client)[2])
    for name in ("../../etc/passwd", "a/b", "C:\\x", "", "···"):
        assert re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", slug(name)), name


def test_without_a_build_there_is_a_problem(client, player):
    (player / "player.js").unlink()
    assert "make webclient" in problem(client.post("/api/export", json=body()), 501)["remedy"]
