package deixis.spy;

import bot_core.image_metadata_t;
import bot_core.image_t;
import bot_core.images_t;
import java.awt.image.BufferedImage;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.util.Arrays;
import java.util.List;
import java.util.zip.Deflater;
import javax.imageio.ImageIO;
import kinect.depth_msg_t;
import kinect.frame_msg_t;
import kinect.image_msg_t;

/** What pictures come out of messages, good ones and lying ones. */
final class PicturesTest {
  private static final int RED = 0xff0000;
  private static final int BLUE = 0x0000ff;

  private PicturesTest() {}

  public static void rgbAndBgrKeepTheirColours() throws Exception {
    byte[] redThenBlue = {-1, 0, 0, 0, 0, -1};
    equalPixels(one(raw(2, 1, 6, image_t.PIXEL_FORMAT_RGB, redThenBlue)), RED, BLUE);
    equalPixels(one(raw(2, 1, 6, image_t.PIXEL_FORMAT_BGR, redThenBlue)), BLUE, RED);
  }

  public static void greyIsGrey() throws Exception {
    equalPixels(one(raw(2, 1, 2, image_t.PIXEL_FORMAT_GRAY, new byte[] {0, (byte) 0x80})), 0,
        0x808080);
  }

  public static void rowsMayBePadded() throws Exception {
    byte[] data = {10, 99, 99, 20, 99};
    BufferedImage image = one(raw(1, 2, 3, image_t.PIXEL_FORMAT_GRAY, data)).image;
    Checks.equal(0x0a0a0a, image.getRGB(0, 0) & 0xffffff);
    Checks.equal(0x141414, image.getRGB(0, 1) & 0xffffff);
  }

  // Full-range BT.601: red is Y 76, U 85, V 255.
  public static void yuyvIsRedWhereItSaysSo() throws Exception {
    byte[] data = {76, 85, 76, -1};
    for (int column = 0; column < 2; ++column) {
      int colour = one(raw(2, 1, 4, image_t.PIXEL_FORMAT_YUYV, data)).image.getRGB(column, 0);
      Checks.isTrue((colour >> 16 & 0xff) > 250, "red");
      Checks.isTrue((colour >> 8 & 0xff) < 5 && (colour & 0xff) < 5, "neither green nor blue");
    }
  }

  public static void yuyvOfOddWidthStaysWithinItsRow() throws Exception {
    Checks.equal(1, one(raw(1, 1, 2, image_t.PIXEL_FORMAT_YUYV, new byte[] {0, -128})).image
        .getWidth());
  }

  public static void jpegIsDecoded() throws Exception {
    int colour = one(jpeg(64, 48, 64, 48)).image.getRGB(10, 10);
    Checks.isTrue((colour >> 16 & 0xff) > 240 && (colour & 0xff) < 15, "red");
  }

  public static void jpegOfAnotherSizeIsShownAndSaid() throws Exception {
    Picture picture = one(jpeg(64, 48, 640, 480));
    Checks.equal(64, picture.image.getWidth());
    Checks.isTrue(picture.title.contains("the message says 640 x 480"), picture.title);
  }

  public static void damagedJpegIsRefused() throws Exception {
    Checks.damaged("does not begin like one",
        () -> one(raw(2, 2, 6, image_t.PIXEL_FORMAT_MJPEG, new byte[] {1, 2, 3})));
    image_t noise = jpeg(64, 48, 64, 48);
    Arrays.fill(noise.data, 2, noise.data.length, (byte) 0x55);
    Checks.damaged("JPEG file: ", () -> one(noise));
    image_t cut = jpeg(64, 48, 64, 48);
    cut.data = Arrays.copyOf(cut.data, 100);
    cut.size = 100;
    Checks.damaged("JPEG file: ", () -> one(cut));
  }

  /** The size in a JPEG header is a claim, too: two bytes each. */
  public static void jpegThatClaimsGigabytesIsRefused() throws Exception {
    image_t image = jpeg(64, 48, 64, 48);
    byte[] claim = {0x7f, (byte) 0xff, 0x7f, (byte) 0xff};
    System.arraycopy(claim, 0, image.data, startOfFrame(image.data) + 5, 4);
    Checks.damaged("is too large", () -> one(image));
  }

  public static void lyingSizesAreRefused() throws Exception {
    int grey = image_t.PIXEL_FORMAT_GRAY;
    Checks.damaged("is not positive", () -> one(raw(-1, 1, 1, grey, new byte[1])));
    Checks.damaged("is not positive", () -> one(raw(1, 0, 1, grey, new byte[1])));
    Checks.damaged("row_stride 1 is less", () -> one(raw(2, 1, 1, grey, new byte[2])));
    Checks.damaged("needs 4", () -> one(raw(2, 2, 2, grey, new byte[3])));
    Checks.damaged("too large", () -> one(raw(1 << 20, 1 << 20, 1 << 20, grey, new byte[9])));
    Checks.damaged("needs", () -> one(raw(1, 3, Integer.MAX_VALUE, grey, new byte[9])));
    Checks.damaged("pixelformat 7 is not known", () -> one(raw(1, 1, 1, 7, new byte[1])));
  }

  public static void depthIsColouredFromNearToFar() throws Exception {
    Picture depth = PicturePlugin.decode(Checks.encoded(
        stereo(zipped(3, 1, shorts(0, 1000, 4000), images_t.DEPTH_MM_ZIPPED)))).get(1);
    equalPixels(depth, 0, RED, BLUE);
    Checks.equal("1.0 to 4.0 m", legend(depth));
  }

  public static void disparityKeepsItsNumbers() throws Exception {
    Picture disparity = PicturePlugin.decode(Checks.encoded(
        stereo(zipped(2, 1, shorts(16, 640), images_t.DISPARITY_ZIPPED)))).get(1);
    Checks.equal("16.0 to 640.0 as stored", legend(disparity));
  }

  public static void emptyDepthIsBlack() throws Exception {
    Picture depth = PicturePlugin.decode(Checks.encoded(
        stereo(zipped(2, 1, shorts(0, 0), images_t.DEPTH_MM_ZIPPED)))).get(1);
    equalPixels(depth, 0, 0);
  }

  public static void badZlibIsRefused() throws Exception {
    images_t noise = stereo(zipped(2, 1, shorts(1, 2), images_t.DEPTH_MM_ZIPPED));
    Arrays.fill(noise.images[1].data, (byte) 0x55);
    Checks.damaged("does not unzip", () -> BotCorePictures.all(noise));
    for (int bytes : new int[] {2, 6, 1 << 20}) {
      images_t lying = stereo(zipped(2, 1, new byte[bytes], images_t.DEPTH_MM_ZIPPED));
      Checks.damaged("does not unzip to the 4 bytes", () -> BotCorePictures.all(lying));
    }
    images_t cut = stereo(zipped(2, 1, shorts(1, 2), images_t.DEPTH_MM_ZIPPED));
    cut.images[1].data = Arrays.copyOf(cut.images[1].data, 5);
    Checks.damaged("does not unzip to the 4 bytes", () -> BotCorePictures.all(cut));
  }

  public static void zlibOfLyingGeometryIsRefusedBeforeMemoryIsTaken() throws Exception {
    images_t images = stereo(zipped(2, 1, shorts(1, 2), images_t.DEPTH_MM_ZIPPED));
    images.images[1].row_stride = Integer.MAX_VALUE;
    images.images[1].height = Integer.MAX_VALUE;
    Checks.damaged("make no picture", () -> BotCorePictures.all(images));
    images.images[1].row_stride = -4;
    Checks.damaged("make no picture", () -> BotCorePictures.all(images));
  }

  public static void anotherTypeIsRefused() throws Exception {
    Checks.damaged("another type", () -> PicturePlugin.decode(new byte[100]));
    Checks.damaged("another type", () -> PicturePlugin.decode(new byte[3]));
  }

  public static void kinectFrameHasColourAndDepth() throws Exception {
    frame_msg_t frame = kinectFrame();
    List<Picture> pictures = PicturePlugin.decode(Checks.encoded(frame));
    equalPixels(pictures.get(0), RED, BLUE);
    equalPixels(pictures.get(1), RED, BLUE);
    Checks.equal("0.5 to 3.0 m", legend(pictures.get(1)));
    frame.depth.timestamp = 0;
    Checks.equal(1, PicturePlugin.decode(Checks.encoded(frame)).size());
  }

  public static void kinectFrameThatLiesIsRefused() throws Exception {
    frame_msg_t frame = kinectFrame();
    frame.image.width = 3;
    Checks.damaged("needs 9", () -> KinectPictures.all(frame));
    frame.image.width = -2;
    Checks.damaged("is not positive", () -> KinectPictures.all(frame));
    frame.image.timestamp = 0;
    frame.depth.depth_data_format = depth_msg_t.DEPTH_11BIT_PACKED;
    Checks.damaged("cannot be shown", () -> KinectPictures.all(frame));
  }

  /** A JPEG and its depth image, as they go over the bus. */
  static byte[] stereoMessage() throws IOException {
    return Checks.encoded(stereo(zipped(2, 1, shorts(1000, 2000), images_t.DEPTH_MM_ZIPPED)));
  }

  private static Picture one(image_t image) throws DamagedMessage {
    return BotCorePictures.one(image, "");
  }

  private static String legend(Picture picture) {
    return picture.legend.low + " to " + picture.legend.high + " " + picture.legend.unit;
  }

  private static void equalPixels(Picture picture, int... colours) {
    for (int column = 0; column < colours.length; ++column) {
      Checks.equal(String.format("%06x", colours[column]),
          String.format("%06x", picture.image.getRGB(column, 0) & 0xffffff));
    }
  }

  private static image_t raw(int width, int height, int stride, int format, byte[] data) {
    image_t image = new image_t();
    image.width = width;
    image.height = height;
    image.row_stride = stride;
    image.pixelformat = format;
    image.data = data;
    image.size = data.length;
    image.metadata = new image_metadata_t[0];
    return image;
  }

  /** A red JPEG; the message claims a size of its own. */
  private static image_t jpeg(int width, int height, int claimedWidth, int claimedHeight)
      throws IOException {
    BufferedImage picture = new BufferedImage(width, height, BufferedImage.TYPE_INT_RGB);
    for (int i = 0; i < width * height; ++i) {
      picture.setRGB(i % width, i / width, RED);
    }
    ByteArrayOutputStream file = new ByteArrayOutputStream();
    ImageIO.write(picture, "jpeg", file);
    return raw(claimedWidth, claimedHeight, 3 * claimedWidth, image_t.PIXEL_FORMAT_MJPEG,
        file.toByteArray());
  }

  private static int startOfFrame(byte[] jpeg) {
    int place = 2;
    while (jpeg[place + 1] != (byte) 0xc0) {
      place += 2 + ((jpeg[place + 2] & 0xff) << 8 | jpeg[place + 3] & 0xff);
    }
    return place;
  }

  private static images_t stereo(images_t one) throws IOException {
    images_t images = new images_t();
    images.n_images = 2;
    images.image_types = new short[] {images_t.LEFT, one.image_types[0]};
    images.images = new image_t[] {jpeg(8, 8, 8, 8), one.images[0]};
    return images;
  }

  private static images_t zipped(int width, int height, byte[] rows, short type) {
    images_t images = new images_t();
    images.image_types = new short[] {type};
    images.images = new image_t[] {
        raw(width, height, 2 * width, image_t.PIXEL_FORMAT_INVALID, zip(rows))};
    return images;
  }

  private static byte[] zip(byte[] data) {
    Deflater deflater = new Deflater();
    deflater.setInput(data);
    deflater.finish();
    byte[] packed = new byte[data.length + 100];
    int length = deflater.deflate(packed);
    deflater.end();
    return Arrays.copyOf(packed, length);
  }

  private static byte[] shorts(int... values) {
    byte[] bytes = new byte[2 * values.length];
    for (int i = 0; i < values.length; ++i) {
      bytes[2 * i] = (byte) values[i];
      bytes[2 * i + 1] = (byte) (values[i] >> 8);
    }
    return bytes;
  }

  private static frame_msg_t kinectFrame() {
    frame_msg_t frame = new frame_msg_t();
    frame.image = new image_msg_t();
    frame.image.timestamp = 1;
    frame.image.width = 2;
    frame.image.height = 1;
    frame.image.image_data = new byte[] {-1, 0, 0, 0, 0, -1};
    frame.image.image_data_nbytes = 6;
    frame.image.image_data_format = image_msg_t.VIDEO_RGB;
    frame.depth = new depth_msg_t();
    frame.depth.timestamp = 1;
    frame.depth.width = 2;
    frame.depth.height = 1;
    frame.depth.depth_data = zip(shorts(500, 3000));
    frame.depth.depth_data_nbytes = frame.depth.depth_data.length;
    frame.depth.depth_data_format = depth_msg_t.DEPTH_MM;
    frame.depth.compression = depth_msg_t.COMPRESSION_ZLIB;
    return frame;
  }
}
