package deixis.spy;

import java.awt.image.BufferedImage;

/** Raw pixels as pictures, in the colours that the camera saw. */
final class RawFormats {
  /** Gives the colour of a pixel, 0xRRGGBB. */
  private interface Colour {
    int at(int row, int column);
  }

  private RawFormats() {}

  /** One byte per pixel. */
  static BufferedImage grey(Pixels pixels) {
    return paint(pixels, (row, column) -> 0x010101 * pixels.unsignedByte(row, column));
  }

  /** One byte per pixel, of which only zero or not matters. */
  static BufferedImage mask(Pixels pixels) {
    return paint(pixels,
        (row, column) -> pixels.unsignedByte(row, column) == 0 ? 0x000000 : 0xffffff);
  }

  /** Three bytes per pixel; red is the one with the number `red`, the first being 0. */
  static BufferedImage colour(Pixels pixels, int red) {
    return paint(pixels, (row, column) -> pixels.unsignedByte(row, 3 * column + red) << 16
        | pixels.unsignedByte(row, 3 * column + 1) << 8
        | pixels.unsignedByte(row, 3 * column + 2 - red));
  }

  /** YUV 4:2:2, two bytes per pixel; `luma` is the place of the first Y: 0 in YUYV, 1 in UYVY. */
  static BufferedImage yuv422(Pixels pixels, int luma) {
    return paint(pixels, (row, column) -> {
      int pair = 4 * (column / 2) + 1 - luma;
      boolean hasV = pair + 2 < 2 * pixels.width;  // not in the last column of an odd width
      int u = pixels.unsignedByte(row, pair);
      int v = hasV ? pixels.unsignedByte(row, pair + 2) : 128;
      return fromYuv(pixels.unsignedByte(row, 2 * column + luma), u - 128, v - 128);
    });
  }

  // ITU-R BT.601, full range, as cameras and OpenCV have it to within a few steps.
  private static int fromYuv(int y, int u, int v) {
    int red = clamp(y + 1.402 * v);
    int green = clamp(y - 0.344136 * u - 0.714136 * v);
    int blue = clamp(y + 1.772 * u);
    return red << 16 | green << 8 | blue;
  }

  private static int clamp(double value) {
    return (int) Math.round(Math.max(0, Math.min(255, value)));
  }

  private static BufferedImage paint(Pixels pixels, Colour colour) {
    BufferedImage image =
        new BufferedImage(pixels.width, pixels.height, BufferedImage.TYPE_INT_RGB);
    int[] line = new int[pixels.width];
    for (int row = 0; row < pixels.height; ++row) {
      for (int column = 0; column < pixels.width; ++column) {
        line[column] = colour.at(row, column);
      }
      image.setRGB(0, row, pixels.width, 1, line, 0, pixels.width);
    }
    return image;
  }
}
