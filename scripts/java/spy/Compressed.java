package deixis.spy;

import java.awt.image.BufferedImage;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.util.zip.DataFormatException;
import java.util.zip.Inflater;
import javax.imageio.ImageIO;
import javax.imageio.ImageReader;
import javax.imageio.stream.ImageInputStream;

/** JPEG files and zlib streams from messages. Both may claim any size: it is checked first. */
final class Compressed {
  private Compressed() {}

  /** Decodes one JPEG file of no more than Pixels.MAX_PIXELS. */
  static BufferedImage jpeg(byte[] file) throws DamagedMessage {
    if (file.length < 2 || (file[0] & 0xff) != 0xff || (file[1] & 0xff) != 0xd8) {
      throw new DamagedMessage("JPEG file: it does not begin like one");
    }
    ImageReader reader = ImageIO.getImageReadersByFormatName("jpeg").next();
    try (ImageInputStream stream = ImageIO.createImageInputStream(new ByteArrayInputStream(file))) {
      reader.setInput(stream, true, true);
      Pixels.checkSize(reader.getWidth(0), reader.getHeight(0));
      return reader.read(0);
    } catch (IOException | RuntimeException error) {
      // The reader throws exceptions of all kinds at damaged files, not its own alone.
      throw new DamagedMessage("JPEG file: " + error.getMessage());
    } finally {
      reader.dispose();
    }
  }

  /** Unzips a zlib stream that must be of exactly `rows` rows of `stride` bytes. */
  static byte[] unzip(byte[] stream, int stride, int rows) throws DamagedMessage {
    long expected = (long) stride * rows;
    if (stride <= 0 || rows <= 0 || expected > 8L * Pixels.MAX_PIXELS) {
      throw new DamagedMessage(
          String.format("row_stride %d and height %d make no picture", stride, rows));
    }
    byte[] data = new byte[(int) expected];
    Inflater inflater = new Inflater();
    try {
      inflater.setInput(stream);
      int length = fill(inflater, data);
      if (length != expected || inflater.inflate(new byte[1]) != 0 || !inflater.finished()) {
        throw new DamagedMessage(
            String.format("does not unzip to the %d bytes of its geometry", expected));
      }
      return data;
    } catch (DataFormatException error) {
      throw new DamagedMessage("does not unzip: " + error.getMessage());
    } finally {
      inflater.end();
    }
  }

  private static int fill(Inflater inflater, byte[] data) throws DataFormatException {
    int length = 0;
    int more;
    do {
      more = inflater.inflate(data, length, data.length - length);
      length += more;
    } while (more > 0 && length < data.length);
    return length;
  }
}
