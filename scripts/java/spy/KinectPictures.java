package deixis.spy;

import java.awt.image.BufferedImage;
import java.util.ArrayList;
import java.util.List;
import kinect.depth_msg_t;
import kinect.frame_msg_t;
import kinect.image_msg_t;

/** The pictures in kinect.frame_msg_t. Rows follow each other without a gap. */
final class KinectPictures {
  private KinectPictures() {}

  /** Colour and depth, as far as the frame has them. */
  static List<Picture> all(frame_msg_t message) throws DamagedMessage {
    List<Picture> pictures = new ArrayList<>();
    if (message.image.timestamp != 0 && message.image.image_data_format != image_msg_t.VIDEO_NONE) {
      pictures.add(colour(message.image));
    }
    if (message.depth.timestamp != 0 && message.depth.depth_data_format != depth_msg_t.DEPTH_NONE) {
      pictures.add(depth(message.depth));
    }
    return pictures;
  }

  private static Picture colour(image_msg_t image) throws DamagedMessage {
    switch (image.image_data_format) {
      case image_msg_t.VIDEO_RGB:
        return plain(image, "RGB", RawFormats.colour(pixels(image, 3), 0));
      case image_msg_t.VIDEO_BAYER:
        return plain(image, "Bayer pattern as grey", RawFormats.grey(pixels(image, 1)));
      case image_msg_t.VIDEO_IR_8BIT:
        return plain(image, "infrared", RawFormats.grey(pixels(image, 1)));
      case image_msg_t.VIDEO_IR_10BIT:
        return ColourScale.paint(
            BotCorePictures.title("", image.width, image.height, "infrared"), pixels(image, 2), 1.0,
            "as stored");
      case image_msg_t.VIDEO_YUV_RAW:
        return plain(image, "UYVY", RawFormats.yuv422(pixels(image, 2), 1));
      case image_msg_t.VIDEO_RGB_JPEG:
        return plain(image, "JPEG", Compressed.jpeg(image.image_data));
      default:
        throw new DamagedMessage(
            "image_data_format " + image.image_data_format + " cannot be shown");
    }
  }

  private static Picture depth(depth_msg_t depth) throws DamagedMessage {
    boolean isMetric = isMetric(depth.depth_data_format);
    int stride = 2 * depth.width;
    Pixels pixels =
        Pixels.checked(depth.width, depth.height, stride, 2, unpacked(depth, stride));
    String title = BotCorePictures.title("depth", depth.width, depth.height, "16 bit");
    return isMetric ? ColourScale.paint(title, pixels, 0.001, "m")
        : ColourScale.paint(title, pixels, 1.0, "as stored");
  }

  private static boolean isMetric(byte format) throws DamagedMessage {
    switch (format) {
      case depth_msg_t.DEPTH_MM:
      case depth_msg_t.DEPTH_REGISTERED:
        return true;
      case depth_msg_t.DEPTH_11BIT:
      case depth_msg_t.DEPTH_10BIT:
        return false;
      default:
        throw new DamagedMessage("depth_data_format " + format + " cannot be shown");
    }
  }

  private static byte[] unpacked(depth_msg_t depth, int stride) throws DamagedMessage {
    switch (depth.compression) {
      case depth_msg_t.COMPRESSION_NONE:
        return depth.depth_data;
      case depth_msg_t.COMPRESSION_ZLIB:
        return Compressed.unzip(depth.depth_data, stride, depth.height);
      default:
        throw new DamagedMessage("compression " + depth.compression + " is not known");
    }
  }

  private static Picture plain(image_msg_t image, String format, BufferedImage picture) {
    String title = BotCorePictures.title("", image.width, image.height, format);
    return new Picture(title, picture, null);
  }

  private static Pixels pixels(image_msg_t image, int pixelBytes) throws DamagedMessage {
    return Pixels.checked(
        image.width, image.height, image.width * pixelBytes, pixelBytes, image.image_data);
  }
}
