package deixis.spy;

import java.awt.Color;
import java.awt.image.BufferedImage;

/** 16-bit numbers (depth, disparity) as colours; black is "none" (0). */
final class ColourScale {
  private static final int[] COLOURS = colours();

  private ColourScale() {}

  /** The colour of a place on the scale: 0 red, by way of yellow and green, to 1 blue. */
  static int colour(double place) {
    double bounded = Math.max(0, Math.min(1, place));
    return COLOURS[(int) Math.round(bounded * (COLOURS.length - 1))];
  }

  /** A picture and its legend, whose ends are whole halves; pixel times `unitPerStep` is `unit`. */
  static Picture paint(String title, Pixels pixels, double unitPerStep, String unit) {
    int[] range = range(pixels);
    double low = Math.floor(2 * range[0] * unitPerStep) / 2;
    double high = Math.max(Math.ceil(2 * range[1] * unitPerStep) / 2, low + 0.5);
    BufferedImage image =
        new BufferedImage(pixels.width, pixels.height, BufferedImage.TYPE_INT_RGB);
    for (int row = 0; row < pixels.height; ++row) {
      for (int column = 0; column < pixels.width; ++column) {
        int value = pixels.unsignedShort(row, column);
        double place = (value * unitPerStep - low) / (high - low);
        image.setRGB(column, row, value == 0 ? 0 : colour(place));
      }
    }
    return new Picture(title, image, new Picture.Legend(low, high, unit));
  }

  /** The numbers that 2 % fall below and exceed: outliers do not stretch the scale. */
  private static int[] range(Pixels pixels) {
    int[] counts = new int[1 << 16];
    for (int row = 0; row < pixels.height; ++row) {
      for (int column = 0; column < pixels.width; ++column) {
        ++counts[pixels.unsignedShort(row, column)];
      }
    }
    int total = pixels.width * pixels.height - counts[0];
    return new int[] {quantile(counts, total * 0.02), quantile(counts, total * 0.98)};
  }

  private static int quantile(int[] counts, double rank) {
    int value = 1;
    for (long sum = counts[1]; sum <= rank && value < counts.length - 1; sum += counts[value]) {
      ++value;
    }
    return value;
  }

  private static int[] colours() {
    int[] colours = new int[256];
    for (int i = 0; i < colours.length; ++i) {
      colours[i] = Color.HSBtoRGB(i / (float) (colours.length - 1) * 2 / 3, 1, 1) & 0xffffff;
    }
    return colours;
  }
}
