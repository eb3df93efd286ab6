"""Pictures by Mitsuba with nacre_bsdf beside those of `nacre render`."""

import pytest
from conftest import DOCUMENTS


@pytest.mark.parametrize("name", ["brass", "glass"])
def test_pictures_are_those_of_nacre_render(name, tmp_path):
    """The same triangles, camera and light; means within their noise."""
    import compare

    theirs, ours = compare.pictures(DOCUMENTS / f"{name}.mtlx", tmp_path, size=32, spp=32, runs=4)
    mean, _, z, error, noise = compare.agreement(theirs, ours, compare.of_ball(32))
    assert mean > 0.1 and abs(z) < 5, (mean, z)
    assert error < 4 * noise, (error, noise)
