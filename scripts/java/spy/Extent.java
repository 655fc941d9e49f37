package deixis.spy;

/** The box that all people so far were in, metres, in steps that leave room around them. */
final class Extent {
  private static final double STEP_M = 0.5;
  private static final double MARGIN_M = 0.15;

  private final double[] low = {Double.POSITIVE_INFINITY, Double.POSITIVE_INFINITY,
      Double.POSITIVE_INFINITY};
  private final double[] high = {Double.NEGATIVE_INFINITY, Double.NEGATIVE_INFINITY,
      Double.NEGATIVE_INFINITY};

  /** Grows until the people fit in; lost limbs do not count, since they may be anywhere. */
  void include(Figures figures) {
    for (Figure figure : figures.people) {
      for (Figure.Line line : figure.lines) {
        if (line.state != Figure.State.LOST) {
          include(line.proximal);
          include(line.distal);
        }
      }
    }
  }

  private void include(double[] point) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = Math.min(low[axis], Math.floor((point[axis] - MARGIN_M) / STEP_M) * STEP_M);
      high[axis] = Math.max(high[axis], Math.ceil((point[axis] + MARGIN_M) / STEP_M) * STEP_M);
    }
  }

  boolean isEmpty() {
    return low[0] > high[0];
  }

  /** The lower end of an axis (0 x, 1 y, 2 z), metres. */
  double low(int axis) {
    return low[axis];
  }

  /** The upper end of an axis, metres. */
  double high(int axis) {
    return high[axis];
  }

  /** The length of an axis, metres. */
  double size(int axis) {
    return high[axis] - low[axis];
  }
}
