package deixis.spy;

import java.awt.BasicStroke;
import java.awt.Color;
import java.awt.Dimension;
import java.awt.Graphics2D;
import java.awt.Stroke;
import java.awt.event.MouseAdapter;
import java.awt.event.MouseEvent;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

/** People as stick figures, from the front, from the side and from above, in one scale. */
final class BodyView extends LiveView<Figures> {
  private static final long serialVersionUID = 1L;
  private static final int GAP = 56;
  private static final int SIDE = 1;
  private static final int MOST_LETTERS = 60;
  private static final Stroke THICK =
      new BasicStroke(4, BasicStroke.CAP_ROUND, BasicStroke.JOIN_ROUND);
  private static final Stroke DASHED =
      new BasicStroke(3, BasicStroke.CAP_BUTT, BasicStroke.JOIN_ROUND, 1,
          new float[] {7, 5}, 0);

  private transient Extent extent = new Extent();

  BodyView() {
    setPreferredSize(new Dimension(960, 640));
    addMouseListener(new MouseAdapter() {
      @Override
      public void mouseClicked(MouseEvent event) {
        extent = new Extent();
        repaint();
      }
    });
  }

  /** The colour that tells how far a limb is to be trusted. */
  static Color colour(Figure.State state) {
    switch (state) {
      case MEASURED:
        return new Color(40, 210, 90);
      case INFERRED:
        return new Color(255, 190, 0);
      case HIDDEN:
        return new Color(90, 140, 255);
      case LOST:
        return new Color(235, 60, 60);
      default:
        return new Color(200, 200, 200);
    }
  }

  @Override
  void draw(Graphics2D graphics, Figures figures) {
    extent.include(figures);
    if (extent.isEmpty()) {
      graphics.setColor(TEXT);
      graphics.drawString("nobody there", 10, 20);
      return;
    }
    Projection[] projections = projections();
    for (Projection projection : projections) {
      Grid.draw(graphics, projection);
      for (Figure figure : figures.people) {
        drawFigure(graphics, projection, figure);
      }
    }
    drawLegend(graphics, figures, projections[SIDE]);
  }

  /** The side stands to the right of the front at the same height, the top view below it. */
  private Projection[] projections() {
    double width = Math.max(50, getWidth() - 3 * GAP);
    double height = Math.max(50, getHeight() - 3 * GAP);
    double acrossM = extent.size(0) + extent.size(2);
    double downM = extent.size(1) + extent.size(2);
    double scale = Math.min(width / acrossM, height / downM);
    int right = 2 * GAP + (int) (extent.size(0) * scale);
    int below = 2 * GAP + (int) (extent.size(1) * scale);
    return new Projection[] {
        new Projection("front", extent, scale, 0, 1, GAP, GAP),
        new Projection("side", extent, scale, 2, 1, right, GAP),
        new Projection("top", extent, scale, 0, 2, GAP, below)};
  }

  private static void drawFigure(Graphics2D graphics, Projection view, Figure figure) {
    int top = Integer.MAX_VALUE;
    int labelColumn = 0;
    for (Figure.Line line : figure.lines) {
      drawLine(graphics, view, line);
      if (view.row(line.distal) < top) {
        top = view.row(line.distal);
        labelColumn = view.column(line.distal);
      }
    }
    if (!figure.lines.isEmpty()) {
      graphics.setColor(TEXT);
      graphics.drawString("person " + figure.personId, labelColumn + 8, top - 4);
    }
  }

  private static void drawLine(Graphics2D graphics, Projection view, Figure.Line line) {
    graphics.setColor(colour(line.state));
    graphics.setStroke(line.state == Figure.State.HIDDEN ? DASHED : THICK);
    int fromColumn = view.column(line.proximal);
    int fromRow = view.row(line.proximal);
    int toColumn = view.column(line.distal);
    int toRow = view.row(line.distal);
    graphics.drawLine(fromColumn, fromRow, toColumn, toRow);
    graphics.fillOval(fromColumn - 4, fromRow - 4, 9, 9);
    graphics.fillOval(toColumn - 4, toRow - 4, 9, 9);
  }

  /** Below the side view, where nothing else is. */
  private void drawLegend(Graphics2D graphics, Figures figures, Projection side) {
    int left = side.place.x;
    int line = graphics.getFontMetrics().getHeight();
    int baseline = side.place.y + side.place.height + GAP + line;
    for (Figure.State state : Figure.State.values()) {
      graphics.setColor(colour(state));
      graphics.fillRect(left, baseline - 9, 24, 9);
      graphics.setColor(TEXT);
      graphics.drawString(state.name().toLowerCase(Locale.ROOT).replace('_', ' '), left + 32,
          baseline);
      baseline += line;
    }
    for (String text : captions(figures)) {
      graphics.drawString(text, left, baseline);
      baseline += line;
    }
  }

  private static List<String> captions(Figures figures) {
    List<String> captions = new ArrayList<>();
    String frame = figures.frame.substring(0, Math.min(MOST_LETTERS, figures.frame.length()));
    captions.add(frame.isEmpty() ? "metres" : "metres, frame " + frame);
    captions.add("a click fits the views to the people anew");
    for (Figure figure : figures.people) {
      captions.add("person " + figure.personId + ": " + figure.remark);
    }
    return captions;
  }
}
