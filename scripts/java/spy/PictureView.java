package deixis.spy;

import java.awt.Color;
import java.awt.Dimension;
import java.awt.FontMetrics;
import java.awt.Graphics2D;
import java.awt.Rectangle;
import java.awt.RenderingHints;
import java.util.List;

/** Pictures beside or below each other, as large as the window lets them be. */
final class PictureView extends LiveView<List<Picture>> {
  private static final long serialVersionUID = 1L;
  private static final int GAP = 6;
  private static final int LEGEND_WIDTH = 160;

  PictureView() {
    setPreferredSize(new Dimension(960, 480));
  }

  @Override
  void draw(Graphics2D graphics, List<Picture> pictures) {
    if (pictures.isEmpty()) {
      graphics.setColor(TEXT);
      graphics.drawString("the message holds no picture", 10, 20);
      return;
    }
    int columns = bestColumns(graphics, pictures);
    for (int i = 0; i < pictures.size(); ++i) {
      drawOne(graphics, pictures.get(i), cell(pictures.size(), columns, i));
    }
  }

  /** How many beside each other make the first picture largest. */
  private int bestColumns(Graphics2D graphics, List<Picture> pictures) {
    int best = 1;
    int bestWidth = 0;
    for (int columns = 1; columns <= pictures.size(); ++columns) {
      int width = place(graphics, pictures.get(0), cell(pictures.size(), columns, 0)).width;
      if (width > bestWidth) {
        best = columns;
        bestWidth = width;
      }
    }
    return best;
  }

  private Rectangle cell(int count, int columns, int index) {
    int rows = (count + columns - 1) / columns;
    int width = getWidth() / columns;
    int height = getHeight() / rows;
    return new Rectangle(index % columns * width, index / columns * height, width, height);
  }

  /** The picture's place in its cell, below the line about it, shape kept. */
  private static Rectangle place(Graphics2D graphics, Picture picture, Rectangle cell) {
    int top = graphics.getFontMetrics().getHeight() + 2 * GAP;
    int width = Math.max(1, cell.width - 2 * GAP);
    int height = Math.max(1, cell.height - top - GAP);
    double scale = Math.min(width / (double) picture.image.getWidth(),
        height / (double) picture.image.getHeight());
    int drawnWidth = Math.max(1, (int) (picture.image.getWidth() * scale));
    int drawnHeight = Math.max(1, (int) (picture.image.getHeight() * scale));
    return new Rectangle(
        cell.x + (cell.width - drawnWidth) / 2, cell.y + top, drawnWidth, drawnHeight);
  }

  private static void drawOne(Graphics2D graphics, Picture picture, Rectangle cell) {
    Rectangle place = place(graphics, picture, cell);
    int baseline = cell.y + GAP + graphics.getFontMetrics().getAscent();
    graphics.setColor(TEXT);
    graphics.drawString(picture.title, cell.x + GAP, baseline);
    // Colours that stand for numbers are not blended.
    graphics.setRenderingHint(RenderingHints.KEY_INTERPOLATION, picture.legend == null
        ? RenderingHints.VALUE_INTERPOLATION_BILINEAR
        : RenderingHints.VALUE_INTERPOLATION_NEAREST_NEIGHBOR);
    graphics.drawImage(picture.image, place.x, place.y, place.width, place.height, null);
    if (picture.legend != null) {
      drawLegend(graphics, picture.legend, cell, baseline);
    }
  }

  private static void drawLegend(
      Graphics2D graphics, Picture.Legend legend, Rectangle cell, int baseline) {
    FontMetrics metrics = graphics.getFontMetrics();
    String low = String.format("%.1f", legend.low);
    String high = String.format("%.1f %s", legend.high, legend.unit);
    int right = cell.x + cell.width - GAP - metrics.stringWidth(high);
    int width = Math.min(LEGEND_WIDTH, cell.width / 4);
    int left = right - GAP - width;
    for (int i = 0; i < width; ++i) {
      graphics.setColor(new Color(ColourScale.colour(i / (width - 1.0))));
      graphics.fillRect(left + i, baseline - metrics.getAscent(), 1, metrics.getAscent());
    }
    graphics.setColor(TEXT);
    graphics.drawString(high, right, baseline);
    graphics.drawString(low, left - GAP - metrics.stringWidth(low), baseline);
  }
}
