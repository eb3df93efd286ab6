"""Images that a host has in memory."""

import struct

import nacre
import numpy as np
import pytest

RED, GREEN, BLUE = [1, 0, 0], [0, 1, 0], [0, 0, 1]


def colors(shader, uv):
    return shader.run({"uv0": np.array(uv, np.float32)})["out"]


@pytest.fixture
def painted(documents):
    """A system of its own, and the colour of the image "painted", its texels unfiltered."""
    return nacre.System(), nacre.Document.parse(documents["painted"])


def test_an_array_is_an_image_and_is_replaced_under_shaders(painted):
    system, document = painted
    system.set_image("painted", np.array([[RED, GREEN], [BLUE, RED]], np.uint8) * 255)
    shader = system.compile_outputs(document, ["out"])
    # Row 0 is on top, where v is 1.
    points = [[0.25, 0.75], [0.75, 0.75], [0.25, 0.25], [0.75, 0.25]]
    assert colors(shader, points).tolist() == [RED, GREEN, BLUE, RED]

    system.set_image("painted", np.array([[GREEN, BLUE]], np.float32))
    assert colors(shader, [[0.25, 0.5], [0.75, 0.5]]).tolist() == [GREEN, BLUE]

    system.remove_image("painted")
    assert colors(shader, [[0.25, 0.5]]).tolist() == [GREEN]
    with pytest.raises(nacre.Error):
        system.compile_outputs(document, ["out"])


def test_a_function_finds_images(documents, tmp_path):
    def bmp(color):  # Of a pixel of 24 bits, blue first.
        header = struct.pack("<2sIIIIiiHHIIiiII", b"BM", 58, 0, 54, 40, 1, 1, 1, 24, 0, 4, 0, 0, 0, 0)
        return header + bytes(255 * each for each in reversed(color)) + b"\0"

    (tmp_path / "green.bmp").write_bytes(bmp(GREEN))
    document = nacre.Document.parse(documents["painted"].replace("painted", "painted.bmp"))
    for found, expected in ((bmp(BLUE), BLUE), (tmp_path / "green.bmp", GREEN)):
        system = nacre.System(resolver=lambda name, by, is_image, found=found: found)
        assert colors(system.compile_outputs(document, ["out"]), [[0.5, 0.5]]).tolist() == [expected]
    with pytest.raises(nacre.Error) as caught:
        nacre.System(resolver=lambda *_: 1 / 0).compile_outputs(document, ["out"])
    assert "ZeroDivisionError" in str(caught.value)


@pytest.mark.parametrize(("of", "one"), [(np.uint8, 255), (np.uint16, 65535), (np.float16, 1),
                                         (np.float32, 1)])
def test_samples_of_every_type_and_rows_in_any_order(painted, of, one):
    system, document = painted
    whole = np.array([[RED + [1], BLUE + [1]], [GREEN + [1], RED + [1]]], of) * of(one)
    system.set_image("painted", whole[::-1])
    shader = system.compile_outputs(document, ["out"])
    assert colors(shader, [[0.25, 0.75], [0.75, 0.25]]).tolist() == [GREEN, BLUE]


@pytest.mark.parametrize("pixels", [
    np.zeros((2, 2, 5), np.uint8), np.zeros((2, 2, 3), np.float64), np.zeros(4, np.uint8),
    np.zeros((0, 2, 3), np.uint8), np.zeros((4, 4, 3), np.uint8)[:, ::2],
    np.zeros((4, 4, 4), np.uint8)[:, :, :3], "pixels"])
def test_what_is_no_image_is_refused(painted, pixels):
    system, _ = painted
    with pytest.raises(nacre.Error) as caught:
        system.set_image("painted", pixels)
    assert caught.value.diagnostics[0].code == "bad-array"
