"""What tests of pictures share. A picture is a list of numbers: red, green and blue of each pixel, row by row from the top."""


def smooth_pixels(image, width, height):
    """For each pixel whether it and those around have similar values: no edges, where devices may see another surface, because
    they round positions on the screen."""
    def similar(a, b):
        return all(abs(image[a + k] - image[b + k]) <= 0.3 * max(image[a + k], image[b + k]) for k in range(3))

    result = []
    for y in range(height):
        for x in range(width):
            at = 3 * (y * width + x)
            around = [at + 3 * (dy * width + dx) for dx, dy in ((-1, 0), (1, 0), (0, -1), (0, 1))
                      if 0 <= x + dx < width and 0 <= y + dy < height]
            result.append(all(similar(at, other) for other in around))
    return result
