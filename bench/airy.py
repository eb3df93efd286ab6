"""Colours of thin films, wavelength by wavelength."""

import numpy

WAVELENGTHS = numpy.arange(300.5, 900.0, 1.0)  # In nm.


def gaussians() -> numpy.ndarray:
    """Sensitivities x, y, z per nm: Belcour and Barla, "A Practical Extension to Microfacet Theory
    for the Modeling of Varying Iridescence", SIGGRAPH 2017: Gaussians in wave number, by the
    amplitude, mean and half variance of their transforms."""
    number = 1e9 / WAVELENGTHS

    def curve(amplitude: float, mean: float, half_variance: float) -> numpy.ndarray:
        return amplitude * numpy.exp(-(number - mean) ** 2 / (4.0 * half_variance))

    return numpy.stack([
        curve(5.4856e-13, 1.6810e6, 4.3278e9) + curve(9.7470e-14, 2.2399e6, 4.5282e9),
        curve(4.4201e-13, 1.7953e6, 9.3046e9),
        curve(5.2481e-13, 2.2084e6, 6.6121e9)]) * number / WAVELENGTHS


def observer() -> numpy.ndarray:
    """The CIE 1931 observer as fitted by Wyman, Sloan and Shirley, "Simple Analytic Approximations
    to the CIE XYZ Color Matching Functions", JCGT 2(2), 2013."""
    def lobe(mean: float, below: float, above: float) -> numpy.ndarray:
        offset = WAVELENGTHS - mean
        return numpy.exp(-0.5 * (offset * numpy.where(offset < 0.0, below, above)) ** 2)

    return numpy.stack([
        0.362 * lobe(442.0, 0.0624, 0.0374) + 1.056 * lobe(599.8, 0.0264, 0.0323)
        - 0.065 * lobe(501.1, 0.0490, 0.0382),
        0.821 * lobe(568.8, 0.0213, 0.0247) + 0.286 * lobe(530.9, 0.0613, 0.0322),
        1.217 * lobe(437.0, 0.0845, 0.0278) + 0.681 * lobe(459.0, 0.0385, 0.0725)])


# CIE 1931 primaries, equal-energy white: what thin_film.h works in.
RGB_OF_XYZ = numpy.array([[2.3706743, -0.9000405, -0.4706338],
                          [-0.5138850, 1.4253036, 0.0885814],
                          [0.0052982, -0.0146949, 1.0093968]])


def airy(cosine: float, thicknesses: numpy.ndarray, film: float, substrate: complex) -> numpy.ndarray:
    """Unpolarised reflectance by thickness (in nm) and wavelength, of a film of that index on what
    has the other: Born and Wolf, "Principles of Optics" (7th ed.), 1.6.4."""
    sine2 = 1.0 - cosine * cosine
    in_film = numpy.sqrt(1.0 - sine2 / film ** 2)
    behind = numpy.sqrt(1.0 - sine2 / complex(substrate) ** 2)
    phase = 4.0 * numpy.pi * film * in_film * thicknesses[:, None] / WAVELENGTHS
    turn = numpy.exp(1j * phase)

    def s(n1, c1, n2, c2):
        return (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2)

    def p(n1, c1, n2, c2):
        return (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2)

    total = 0.0
    for amplitude in (s, p):
        front = amplitude(1.0, cosine, film, in_film)
        back = amplitude(film, in_film, substrate, behind)
        total = total + 0.5 * numpy.abs((front + back * turn) / (1.0 + front * back * turn)) ** 2
    return total


def colours(reflected: numpy.ndarray, sensitivity: numpy.ndarray) -> numpy.ndarray:
    """In the CIE's primaries, white 1, within [0, 1], of reflectance by wavelength."""
    xyz = reflected @ sensitivity.T / sensitivity.sum(axis=1)
    return numpy.clip(xyz @ RGB_OF_XYZ.T, 0.0, 1.0)


def displayed(linear: numpy.ndarray) -> numpy.ndarray:
    """sRGB's curve."""
    return numpy.where(linear <= 0.0031308, 12.92 * linear,
                       1.055 * numpy.maximum(linear, 1e-9) ** (1 / 2.4) - 0.055)
