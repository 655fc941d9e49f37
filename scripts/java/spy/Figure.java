package deixis.spy;

import java.util.List;

/** One person as lines. */
final class Figure {
  /** How far a limb is to be trusted; NOT_TOLD where a message does not say. */
  enum State { MEASURED, INFERRED, HIDDEN, LOST, NOT_TOLD }

  /** Metres. What is farther away is no person that a camera could see. */
  private static final double FARTHEST_M = 100;

  final int personId;
  /** The person's state and what else there is to say; may be empty. */
  final String remark;
  final List<Line> lines;

  Figure(int personId, String remark, List<Line> lines) {
    this.personId = personId;
    this.remark = remark;
    this.lines = lines;
  }

  /** One limb, from its proximal to its distal end: x, y, z in the message's frame, metres. */
  static final class Line {
    final double[] proximal;
    final double[] distal;
    final State state;

    Line(double[] proximal, double[] distal, State state) throws DamagedMessage {
      this.proximal = checked(proximal);
      this.distal = checked(distal);
      this.state = state;
    }

    private static double[] checked(double[] point) throws DamagedMessage {
      for (double value : point) {
        if (!(Math.abs(value) <= FARTHEST_M)) {
          throw new DamagedMessage("a limb ends at " + value + " m");
        }
      }
      return point;
    }
  }
}
