package deixis.spy;

import bot_core.image_t;
import bot_core.images_t;
import java.awt.image.BufferedImage;
import java.util.ArrayList;
import java.util.List;

/** The pictures in bot_core.image_t and bot_core.images_t. */
final class BotCorePictures {
  /** What a rig of cameras may hold at most. */
  private static final int MAX_IMAGES = 16;

  private BotCorePictures() {}

  /** All images of a message, in its order. */
  static List<Picture> all(images_t message) throws DamagedMessage {
    if (message.n_images > MAX_IMAGES) {
      throw new DamagedMessage("claims " + message.n_images + " images");
    }
    List<Picture> pictures = new ArrayList<>();
    for (int i = 0; i < message.n_images; ++i) {
      pictures.add(one(message.image_types[i], message.images[i]));
    }
    return pictures;
  }

  /** A single image, told by its pixel format. */
  static Picture one(image_t image, String name) throws DamagedMessage {
    if (image.pixelformat == image_t.PIXEL_FORMAT_LE_GRAY16) {
      return ColourScale.paint(title(name, image.width, image.height, "16 bit"),
          pixels(image, 2), 1.0, "as stored");
    }
    if (image.pixelformat == image_t.PIXEL_FORMAT_MJPEG) {
      return jpeg(image, name);
    }
    return new Picture(title(name, image.width, image.height, formatName(image.pixelformat)),
        raw(image), null);
  }

  static String title(String name, int width, int height, String format) {
    return String.format("%s%d x %d, %s", name.isEmpty() ? "" : name + ": ", width, height, format);
  }

  private static Picture one(short type, image_t image) throws DamagedMessage {
    switch (type) {
      case images_t.LEFT:
        return one(image, "left");
      case images_t.RIGHT:
        return one(image, "right");
      case images_t.DEPTH_MM:
        return depth(image, pixels(image, 2));
      case images_t.DEPTH_MM_ZIPPED:
        return depth(image, unzipped(image, 2));
      case images_t.DISPARITY:
        return disparity(image, pixels(image, 2));
      case images_t.DISPARITY_ZIPPED:
        return disparity(image, unzipped(image, 2));
      case images_t.MASK_ZIPPED:
        return new Picture(title("mask", image.width, image.height, "0 or not"),
            RawFormats.mask(unzipped(image, 1)), null);
      default:
        return one(image, "type " + type);
    }
  }

  private static Picture depth(image_t image, Pixels pixels) {
    return ColourScale.paint(
        title("depth", image.width, image.height, "mm"), pixels, 0.001, "m");
  }

  // The unit of a disparity is the publisher's (often 1/16 pixel): the numbers stay as they are.
  private static Picture disparity(image_t image, Pixels pixels) {
    return ColourScale.paint(
        title("disparity", image.width, image.height, "16 bit"), pixels, 1.0, "as stored");
  }

  private static Picture jpeg(image_t image, String name) throws DamagedMessage {
    BufferedImage decoded = Compressed.jpeg(image.data);
    boolean fits = decoded.getWidth() == image.width && decoded.getHeight() == image.height;
    String format = fits ? "JPEG"
        : String.format("JPEG; the message says %d x %d", image.width, image.height);
    return new Picture(
        title(name, decoded.getWidth(), decoded.getHeight(), format), decoded, null);
  }

  private static BufferedImage raw(image_t image) throws DamagedMessage {
    switch (image.pixelformat) {
      case image_t.PIXEL_FORMAT_GRAY:
        return RawFormats.grey(pixels(image, 1));
      case image_t.PIXEL_FORMAT_RGB:
        return RawFormats.colour(pixels(image, 3), 0);
      case image_t.PIXEL_FORMAT_BGR:
        return RawFormats.colour(pixels(image, 3), 2);
      case image_t.PIXEL_FORMAT_YUYV:
        return RawFormats.yuv422(pixels(image, 2), 0);
      default:
        throw new DamagedMessage("pixelformat " + image.pixelformat + " is not known");
    }
  }

  private static String formatName(int pixelformat) {
    switch (pixelformat) {
      case image_t.PIXEL_FORMAT_GRAY:
        return "grey";
      case image_t.PIXEL_FORMAT_RGB:
        return "RGB";
      case image_t.PIXEL_FORMAT_BGR:
        return "BGR";
      default:
        return "YUYV";
    }
  }

  private static Pixels pixels(image_t image, int pixelBytes) throws DamagedMessage {
    return Pixels.checked(image.width, image.height, image.row_stride, pixelBytes, image.data);
  }

  private static Pixels unzipped(image_t image, int pixelBytes) throws DamagedMessage {
    byte[] data = Compressed.unzip(image.data, image.row_stride, image.height);
    return Pixels.checked(image.width, image.height, image.row_stride, pixelBytes, data);
  }
}
