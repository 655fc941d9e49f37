package deixis.spy;

import deixis.body_pose_t;
import deixis.body_poses_t;
import deixis.finding_t;
import deixis.limb_pose_t;
import deixis.transform_t;
import deixis.verified_body_t;
import deixis.verified_poses_t;
import java.io.IOException;
import kinect.link_msg_t;
import kinect.point3d_t;
import kinect.skeleton_msg_t;

/** What people come out of messages, and how large the views of them are. */
final class BodiesTest {
  private BodiesTest() {}

  public static void limbsKeepPlaceAndState() throws Exception {
    Figures figures = decode(poses(limb(limb_pose_t.HIDDEN, 0.5)));
    Checks.equal("camera", figures.frame);
    Figure figure = figures.people.get(0);
    Checks.equal(7, figure.personId);
    Checks.equal("tracked", figure.remark);
    Checks.equal(Figure.State.HIDDEN, figure.lines.get(0).state);
    Checks.equal(0.5, figure.lines.get(0).distal[1]);
  }

  public static void stateThatIsNotKnownIsNotTold() throws Exception {
    Checks.equal(Figure.State.NOT_TOLD,
        decode(poses(limb((byte) 9, 0.5))).people.get(0).lines.get(0).state);
  }

  public static void verifiedPosesTellTheVerdict() throws Exception {
    verified_body_t body = new verified_body_t();
    body.pose = poses(limb(limb_pose_t.MEASURED, 0.5)).bodies[0];
    body.is_changed = true;
    body.findings = new finding_t[0];
    verified_poses_t message = new verified_poses_t();
    message.camera = "";
    message.frame = "camera";
    message.n_bodies = 1;
    message.bodies = new verified_body_t[] {body};
    Figures figures =
        BodyPlugin.decode(Checks.encoded(message), new SkeletonMemory());
    Checks.equal("tracked, repaired", figures.people.get(0).remark);
  }

  public static void limbsThatAreNowhereAreRefused() throws Exception {
    for (double bad : new double[] {Double.NaN, Double.POSITIVE_INFINITY, -101}) {
      Checks.damaged("a limb ends at",
          () -> Figures.of(poses(limb(limb_pose_t.MEASURED, bad))));
    }
  }

  public static void crowdsAreRefused() throws Exception {
    body_poses_t message = poses(limb(limb_pose_t.MEASURED, 0.5));
    message.n_bodies = Figures.MAX_PEOPLE + 1;
    Checks.damaged("claims 65 people", () -> Figures.of(message));
  }

  public static void skeletonsOfSeveralPeopleAreGathered() throws Exception {
    SkeletonMemory memory = new SkeletonMemory();
    memory.with(skeleton(1, 0));
    Checks.equal(2, memory.with(skeleton(2, 100_000)).people.size());
    Checks.equal(1, memory.with(skeleton(2, 1_050_000)).people.size());
    Checks.equal(1, memory.with(skeleton(1, 0)).people.size());
  }

  public static void noMoreThanACrowdIsGathered() throws Exception {
    SkeletonMemory memory = new SkeletonMemory();
    for (int user = 0; user < Figures.MAX_PEOPLE; ++user) {
      memory.with(skeleton(user, 0));
    }
    Checks.damaged("more than 64 people", () -> memory.with(skeleton(1000, 0)));
    Checks.equal(Figures.MAX_PEOPLE, memory.with(skeleton(0, 0)).people.size());
    Checks.equal(1, memory.with(skeleton(1000, 2_000_000)).people.size());
  }

  public static void extentGrowsAndLeavesLostLimbsOut() throws Exception {
    Extent extent = new Extent();
    Checks.isTrue(extent.isEmpty(), "empty at first");
    extent.include(Figures.of(poses(limb(limb_pose_t.LOST, 50))));
    Checks.isTrue(extent.isEmpty(), "lost limbs do not count");
    extent.include(Figures.of(poses(limb(limb_pose_t.MEASURED, 1.2))));
    Checks.equal(-0.5, extent.low(1));
    Checks.equal(1.5, extent.high(1));
    extent.include(Figures.of(poses(limb(limb_pose_t.MEASURED, 0.1))));
    Checks.equal(1.5, extent.high(1));
  }

  public static void viewsPointWhereTheirTitlesSay() throws Exception {
    Extent extent = new Extent();
    extent.include(Figures.of(poses(limb(limb_pose_t.MEASURED, 1.2))));
    Projection front = new Projection("front", extent, 100, 0, 1, 10, 20);
    Checks.isTrue(front.row(1.0) > front.row(0.0), "y goes down");
    Checks.equal(100, front.row(1.0) - front.row(0.0));
    Projection top = new Projection("top", extent, 100, 0, 2, 10, 20);
    Checks.isTrue(top.row(3.0) < top.row(2.0), "what is far is above");
  }

  /** One person with one limb, as it goes over the bus. */
  static byte[] bodyMessage() throws IOException {
    return Checks.encoded(poses(limb(limb_pose_t.MEASURED, 0.5)));
  }

  private static Figures decode(body_poses_t message) throws Exception {
    return BodyPlugin.decode(Checks.encoded(message), new SkeletonMemory());
  }

  private static body_poses_t poses(limb_pose_t limb) {
    body_pose_t body = new body_pose_t();
    body.person_id = 7;
    body.identity = "";
    body.state = body_pose_t.TRACKED;
    body.root_in_frame = new transform_t();
    body.angles_rad = new double[0];
    body.rates_rad_per_s = new double[0];
    body.covariance = new float[0];
    body.n_limbs = 1;
    body.limbs = new limb_pose_t[] {limb};
    body_poses_t message = new body_poses_t();
    message.camera = "";
    message.frame = "camera";
    message.source = "test";
    message.n_bodies = 1;
    message.bodies = new body_pose_t[] {body};
    return message;
  }

  /** A limb of 2 m depth that reaches from y = 0 to `downM`. */
  private static limb_pose_t limb(byte state, double downM) {
    limb_pose_t limb = new limb_pose_t();
    limb.in_parent = new transform_t();
    limb.in_frame = new transform_t();
    limb.proximal_m[2] = 2;
    limb.distal_m[1] = downM;
    limb.distal_m[2] = 2;
    limb.state = state;
    return limb;
  }

  private static skeleton_msg_t skeleton(int person, long utime) {
    skeleton_msg_t skeleton = new skeleton_msg_t();
    skeleton.utime = utime;
    skeleton.user_id = person;
    skeleton.num_links = 1;
    link_msg_t link = new link_msg_t();
    link.source = new point3d_t();
    link.dest = new point3d_t();
    skeleton.links = new link_msg_t[] {link};
    return skeleton;
  }
}
