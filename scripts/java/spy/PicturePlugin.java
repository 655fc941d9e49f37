package deixis.spy;

import bot_core.image_t;
import bot_core.images_t;
import java.io.IOException;
import java.nio.ByteBuffer;
import java.util.List;
import javax.swing.Action;
import javax.swing.JDesktopPane;
import kinect.frame_msg_t;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;

/** lcm-spy finds it on the class path: shows the pictures of a channel. */
public final class PicturePlugin implements SpyPlugin {
  @Override
  public boolean canHandle(long fingerprint) {
    return fingerprint == image_t.LCM_FINGERPRINT || fingerprint == images_t.LCM_FINGERPRINT
        || fingerprint == frame_msg_t.LCM_FINGERPRINT;
  }

  @Override
  public Action getAction(JDesktopPane desktop, ChannelData channel) {
    return ChannelWindow.action(
        "Pictures...", desktop, channel, PictureView::new, PicturePlugin::decode);
  }

  static List<Picture> decode(byte[] message) throws IOException, DamagedMessage {
    long fingerprint = message.length < 8 ? 0 : ByteBuffer.wrap(message).getLong();
    if (fingerprint == image_t.LCM_FINGERPRINT) {
      return List.of(BotCorePictures.one(new image_t(message), ""));
    }
    if (fingerprint == images_t.LCM_FINGERPRINT) {
      return BotCorePictures.all(new images_t(message));
    }
    if (fingerprint == frame_msg_t.LCM_FINGERPRINT) {
      return KinectPictures.all(new frame_msg_t(message));
    }
    throw new DamagedMessage("a message of another type");
  }

  @Override
  public String toString() {
    return "pictures: bot_core.image_t, bot_core.images_t, kinect.frame_msg_t";
  }
}
