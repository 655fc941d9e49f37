package deixis.spy;

import java.awt.Rectangle;

/** One view along an axis, without perspective: two axes of space onto a part of the window. */
final class Projection {
  final String title;
  final Rectangle place;
  /** The axes (0 x, 1 y, 2 z) that go to the right, and up or down. */
  final int across;
  final int along;
  final Extent extent;
  final double scalePxPerM;
  private final boolean isUpwards;

  /** Puts the view's upper left corner at (left, top). The far axis z goes up, y down. */
  Projection(String title, Extent extent, double scalePxPerM, int across, int along, int left,
      int top) {
    this.title = title;
    this.extent = extent;
    this.scalePxPerM = scalePxPerM;
    this.across = across;
    this.along = along;
    this.isUpwards = along == 2;
    this.place = new Rectangle(left, top, (int) (extent.size(across) * scalePxPerM),
        (int) (extent.size(along) * scalePxPerM));
  }

  int column(double[] point) {
    return column(point[across]);
  }

  int row(double[] point) {
    return row(point[along]);
  }

  /** Pixel column of a length, metres, on the axis that goes to the right. */
  int column(double acrossM) {
    return place.x + (int) Math.round((acrossM - extent.low(across)) * scalePxPerM);
  }

  /** Pixel row of a length, metres, on the other axis. */
  int row(double alongM) {
    double downM = isUpwards ? extent.high(along) - alongM : alongM - extent.low(along);
    return place.y + (int) Math.round(downM * scalePxPerM);
  }
}
