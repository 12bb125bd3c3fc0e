"""Errors, times and efficiencies, with nothing but the standard library of Python."""
import array
import itertools
import math
import pathlib
import statistics
import sys


RELATIVE_EPSILON = 0.01  # as in `nusselt compare`


class Image:
    """Rows of pixels, each with one or three channels, in the order of the PFM file."""

    def __init__(self, width, height, values):
        self.width, self.height, self.values = width, height, values
        self.channels = len(values) // (width * height)
        if len(values) != width * height * self.channels or self.channels not in (1, 3):
            raise ValueError(f"{len(values)} numbers for {width} x {height} pixels")

    def pixels(self):
        return zip(*[iter(self.values)] * self.channels)


def read_pfm(file):
    data = pathlib.Path(file).read_bytes()
    kind, size, scale, body = data.split(b"\n", 3)
    if kind not in (b"PF", b"Pf"):
        raise ValueError(f"{file}: not a PFM file")
    width, height = map(int, size.split())
    values = array.array("f", body)
    if (float(scale) < 0) != (sys.byteorder == "little"):
        values.byteswap()
    return Image(width, height, values)


def all_of(*masks):
    """The pixels that all masks keep."""
    return bytes(map(all, zip(*masks, strict=True)))


def kept(image, mask):
    """The values of all channels of the pixels that the mask keeps."""
    if len(mask) != image.width * image.height:
        raise ValueError("mask and image differ in size")
    selectors = mask if image.channels == 1 else bytes(itertools.chain.from_iterable(zip(mask, mask, mask)))
    return itertools.compress(image.values, selectors)


def finite(value, what):
    if not math.isfinite(value):
        raise ValueError(f"{what} is not finite")
    return value


def mean(image, mask):
    values = [*kept(image, mask)]
    if not values:
        raise ValueError("no pixel is left")
    return finite(math.fsum(values) / len(values), "the mean of an image")


def mean_squared_errors(image, reference, mask):
    """The mean squared error, and the relative one of docs/images.md (`rel_mse`), in which dark pixels count as much as
    bright ones."""
    if (image.width, image.height, image.channels) != (reference.width, reference.height, reference.channels):
        raise ValueError("image and reference differ in size")
    values = [*kept(reference, mask)]
    if not values:
        raise ValueError("no pixel is left")
    squares = [(a - b)**2 for a, b in zip(kept(image, mask), values)]
    relative = (square / (b * b + RELATIVE_EPSILON) for square, b in zip(squares, values))
    return tuple(finite(math.fsum(terms) / len(values), "an error") for terms in (squares, relative))


def median_and_spread(values):
    """The median, and the distance of the quartiles over the median."""
    middle = statistics.median(values)
    if len(values) < 2 or middle == 0:
        return middle, None
    low, _, high = statistics.quantiles(values, n=4, method="inclusive")
    return middle, (high - low) / middle


def time_per_samples(time, samples, time_of_one):
    """The time that samples take without what a rendering of one sample spends on anything else, such as building the
    hierarchy and writing the image."""
    if samples < 2 or time <= time_of_one:
        raise ValueError("no more time for more samples")
    return (time - time_of_one) * samples / (samples - 1)


def efficiency(error, time):
    """What four times the samples leave as it is, if the samples are independent: errors are squared."""
    if error <= 0 or time <= 0:
        raise ValueError("an efficiency without error or time")
    return 1 / (error * time)


def samples_of_equal_time(samples, time, limit):
    """The largest power of two of samples that is expected to take no longer than the limit."""
    return 2**max(0, math.floor(math.log2(samples * limit / time)))
