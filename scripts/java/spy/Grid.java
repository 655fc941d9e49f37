package deixis.spy;

import java.awt.BasicStroke;
import java.awt.Color;
import java.awt.Graphics2D;
import java.util.Locale;

/** The lines behind a view, with lengths in metres: as many as there is room for. */
final class Grid {
  private static final Color LINES = new Color(58, 62, 70);
  private static final Color NUMBERS = new Color(140, 144, 152);
  private static final int LEAST_GAP_PX = 36;
  private static final double[] STEPS_M = {0.5, 1, 2, 5, 10, 20, 50, 100};
  private static final String[] AXES = {"x right", "y down", "z away"};

  private Grid() {}

  static void draw(Graphics2D graphics, Projection view) {
    graphics.setStroke(new BasicStroke(1));
    graphics.setColor(LiveView.TEXT);
    graphics.drawString(String.format("%s (%s, %s)", view.title, AXES[view.across],
        AXES[view.along]), view.place.x, view.place.y - 8);
    double step = stepM(view.scalePxPerM);
    drawColumns(graphics, view, step);
    drawRows(graphics, view, step);
  }

  private static void drawColumns(Graphics2D graphics, Projection view, double stepM) {
    int bottom = view.place.y + view.place.height;
    double last = view.extent.high(view.across);
    for (double metres = first(view.extent.low(view.across), stepM); metres <= last;
        metres += stepM) {
      int column = view.column(metres);
      graphics.setColor(LINES);
      graphics.drawLine(column, view.place.y, column, bottom);
      graphics.setColor(NUMBERS);
      graphics.drawString(text(metres), column - 8, bottom + 14);
    }
  }

  private static void drawRows(Graphics2D graphics, Projection view, double stepM) {
    int right = view.place.x + view.place.width;
    double last = view.extent.high(view.along);
    for (double metres = first(view.extent.low(view.along), stepM); metres <= last;
        metres += stepM) {
      int row = view.row(metres);
      graphics.setColor(LINES);
      graphics.drawLine(view.place.x, row, right, row);
      graphics.setColor(NUMBERS);
      graphics.drawString(text(metres), view.place.x - 30, row + 4);
    }
  }

  private static double stepM(double scalePxPerM) {
    for (double step : STEPS_M) {
      if (step * scalePxPerM >= LEAST_GAP_PX) {
        return step;
      }
    }
    return STEPS_M[STEPS_M.length - 1];
  }

  private static double first(double lowM, double stepM) {
    return Math.ceil(lowM / stepM) * stepM;
  }

  private static String text(double metres) {
    return String.format(Locale.ROOT, "%.1f", metres + 0.0);
  }
}
