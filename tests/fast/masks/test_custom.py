"""Masks made on request."""

import numpy as np

from seafoam.masks.bake import bake_all
from seafoam.masks.catalogue import Mask, Thresholds, mask_by_name, rank_sha256, read_catalogue
from seafoam.masks.families import check_parameters
from seafoam.masks.formats import decode_ranks


def test_a_request_is_answered_from_the_cache_the_second_time_and_names_its_sigma():
    first = mask_by_name("vac:1.5:64:9")
    assert mask_by_name("vac:1.5:64:9") is first
    assert first.entry.parameters.method == "batched"
    assert first.entry.name == "vac-1.5-64-9"
    assert first.entry.sha256 == rank_sha256(first.ranks)
    assert not first.ranks.flags.writeable
    assert not first.spans[0].flags.writeable
    assert check_parameters("blur", None, 64, 0).sigma == 6.0


def test_tables_are_measured_when_asked_for():
    mask = mask_by_name("clump:1.5:128:4")
    assert "tables" not in vars(mask)
    assert len(mask.quantile) == 65
    assert len(mask.tables.sigma_l) == 8
    assert mask.tables.spectrum.frequency[0] == 1 / 128
    assert mask.sidecar()["spectrum"]


def test_baking_writes_what_the_catalogue_reads(tmp_path, monkeypatch):
    from seafoam.masks import bake

    monkeypatch.setattr(bake, "SHIPPED_SIZE", 64)
    monkeypatch.setattr(bake, "SHIPPED", [mask for mask in bake.SHIPPED if mask.sigma <= 8.0])
    seen: list[float] = []
    bake_all(tmp_path / "masks", seen.append)
    assert seen == sorted(seen)
    assert seen[-1] == 1.0
    catalogue = read_catalogue(tmp_path / "masks")
    assert list(catalogue) == [mask.name for mask in bake.SHIPPED]
    for name, (entry, tables) in catalogue.items():
        ranks = decode_ranks((tmp_path / "masks" / f"{name}.ranks").read_bytes(), entry.parameters.width)
        assert rank_sha256(ranks) == entry.sha256
        baked = Thresholds.from_bytes((tmp_path / "masks" / f"{name}.tables").read_bytes())
        computed = Mask(entry, ranks, tables)
        assert baked.quantiles.shape == (8, 65)
        assert np.allclose(baked.quantiles, computed.filtering.quantiles, rtol=0.0, atol=1e-4)
        assert np.allclose(baked.ramps, computed.filtering.ramps, rtol=0.0, atol=1e-4)
        assert np.isfinite(tables.quantile.entries).all()
