package deixis.spy;

import java.awt.image.BufferedImage;

/** One picture to be shown, with a line about it and, where colours mean numbers, a legend. */
final class Picture {
  final String title;
  final BufferedImage image;
  /** Null where colours are what the camera saw. */
  final Legend legend;

  Picture(String title, BufferedImage image, Legend legend) {
    this.title = title;
    this.image = image;
    this.legend = legend;
  }

  /** What the two ends of the colour scale stand for. */
  static final class Legend {
    final double low;
    final double high;
    final String unit;

    Legend(double low, double high, String unit) {
      this.low = low;
      this.high = high;
      this.unit = unit;
    }
  }
}
