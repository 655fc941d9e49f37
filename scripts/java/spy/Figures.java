package deixis.spy;

import deixis.body_pose_t;
import deixis.body_poses_t;
import deixis.limb_pose_t;
import deixis.verified_body_t;
import deixis.verified_poses_t;
import java.util.ArrayList;
import java.util.List;
import kinect.link_msg_t;
import kinect.point3d_t;
import kinect.skeleton_msg_t;

/** The people of one message. */
final class Figures {
  /** A message that claims more people or limbs is damaged. */
  static final int MAX_PEOPLE = 64;
  static final int MAX_LIMBS = 256;

  /** Name of the frame that the lines are given in; empty where a message does not say. */
  final String frame;
  final List<Figure> people;

  Figures(String frame, List<Figure> people) {
    this.frame = frame;
    this.people = people;
  }

  static Figures of(body_poses_t message) throws DamagedMessage {
    checkCount(message.n_bodies, MAX_PEOPLE, "people");
    List<Figure> people = new ArrayList<>();
    for (body_pose_t body : message.bodies) {
      people.add(figure(body, ""));
    }
    return new Figures(message.frame, people);
  }

  static Figures of(verified_poses_t message) throws DamagedMessage {
    checkCount(message.n_bodies, MAX_PEOPLE, "people");
    List<Figure> people = new ArrayList<>();
    for (verified_body_t body : message.bodies) {
      people.add(figure(body.pose, verdict(body)));
    }
    return new Figures(message.frame, people);
  }

  /** This type has one person per message. */
  static Figure of(skeleton_msg_t message) throws DamagedMessage {
    checkCount(message.num_links, MAX_LIMBS, "links");
    List<Figure.Line> lines = new ArrayList<>();
    for (link_msg_t link : message.links) {
      lines.add(new Figure.Line(point(link.source), point(link.dest), Figure.State.NOT_TOLD));
    }
    return new Figure(message.user_id, "", lines);
  }

  private static Figure figure(body_pose_t body, String verdict) throws DamagedMessage {
    checkCount(body.n_limbs, MAX_LIMBS, "limbs");
    List<Figure.Line> lines = new ArrayList<>();
    for (limb_pose_t limb : body.limbs) {
      lines.add(new Figure.Line(limb.proximal_m, limb.distal_m, state(limb.state)));
    }
    return new Figure(body.person_id, personState(body.state) + verdict, lines);
  }

  private static String verdict(verified_body_t body) {
    return (body.is_changed ? ", repaired" : "")
        + (body.n_findings > 0 ? ", findings: " + body.n_findings : "")
        + (body.wants_restart ? ", wants restart" : "");
  }

  private static Figure.State state(byte state) {
    switch (state) {
      case limb_pose_t.MEASURED:
        return Figure.State.MEASURED;
      case limb_pose_t.INFERRED:
        return Figure.State.INFERRED;
      case limb_pose_t.HIDDEN:
        return Figure.State.HIDDEN;
      case limb_pose_t.LOST:
        return Figure.State.LOST;
      default:
        return Figure.State.NOT_TOLD;
    }
  }

  private static String personState(byte state) {
    switch (state) {
      case body_pose_t.STARTING:
        return "starting";
      case body_pose_t.TRACKED:
        return "tracked";
      case body_pose_t.LOST:
        return "lost";
      default:
        return "state " + state;
    }
  }

  private static double[] point(point3d_t point) {
    return new double[] {point.x, point.y, point.z};
  }

  private static void checkCount(int count, int most, String what) throws DamagedMessage {
    if (count > most) {
      throw new DamagedMessage("claims " + count + " " + what);
    }
  }
}
