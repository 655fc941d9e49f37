package deixis.spy;

import deixis.body_poses_t;
import deixis.verified_poses_t;
import java.io.IOException;
import java.nio.ByteBuffer;
import javax.swing.Action;
import javax.swing.JDesktopPane;
import kinect.skeleton_msg_t;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;

/** lcm-spy finds it on the class path: shows the people of a channel as stick figures. */
public final class BodyPlugin implements SpyPlugin {
  @Override
  public boolean canHandle(long fingerprint) {
    return fingerprint == body_poses_t.LCM_FINGERPRINT
        || fingerprint == verified_poses_t.LCM_FINGERPRINT
        || fingerprint == skeleton_msg_t.LCM_FINGERPRINT;
  }

  @Override
  public Action getAction(JDesktopPane desktop, ChannelData channel) {
    SkeletonMemory memory = new SkeletonMemory();
    return ChannelWindow.action(
        "Bodies...", desktop, channel, BodyView::new, message -> decode(message, memory));
  }

  static Figures decode(byte[] message, SkeletonMemory memory)
      throws IOException, DamagedMessage {
    long fingerprint = message.length < 8 ? 0 : ByteBuffer.wrap(message).getLong();
    if (fingerprint == body_poses_t.LCM_FINGERPRINT) {
      return Figures.of(new body_poses_t(message));
    }
    if (fingerprint == verified_poses_t.LCM_FINGERPRINT) {
      return Figures.of(new verified_poses_t(message));
    }
    if (fingerprint == skeleton_msg_t.LCM_FINGERPRINT) {
      return memory.with(new skeleton_msg_t(message));
    }
    throw new DamagedMessage("a message of another type");
  }

  @Override
  public String toString() {
    return "bodies: deixis.body_poses_t, deixis.verified_poses_t, kinect.skeleton_msg_t";
  }
}
