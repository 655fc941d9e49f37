package deixis.spy;

import bot_core.image_metadata_t;
import bot_core.image_t;
import java.io.IOException;
import java.util.Arrays;
import java.util.Random;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;

/** Which messages are decoded, and that none of them ends the feed. */
final class ChannelFeedTest {
  private static final int WAIT_S = 30;
  private static final int MUTILATIONS = 1000;

  private ChannelFeedTest() {}

  public static void newestMessageWinsWhileOneIsDecoded() throws Exception {
    CountDownLatch isDecoding = new CountDownLatch(1);
    CountDownLatch mayGoOn = new CountDownLatch(1);
    Said said = new Said();
    ChannelFeed<Object> feed = new ChannelFeed<>(message -> {
      isDecoding.countDown();
      await(mayGoOn);
      return message[0];
    }, said);
    feed.start("test");
    feed.accept(new byte[] {1});
    await(isDecoding);
    for (byte number = 2; number <= 5; ++number) {
      feed.accept(new byte[] {number});
    }
    mayGoOn.countDown();
    Checks.equal("shown 1", said.next());
    Checks.equal("shown 5", said.next());
    Checks.equal(5L, feed.counts().received);
    Checks.equal(3L, feed.counts().skipped);
    feed.close();
  }

  public static void damagedMessagesAreCountedAndTheNextIsShown() throws Exception {
    Said said = new Said();
    ChannelFeed<Object> feed =
        new ChannelFeed<>(message -> PicturePlugin.decode(message).size(), said);
    feed.start("test");
    byte[] good = Checks.encoded(image(12345));
    byte[][] bad = {Checks.forged(good, 12345, -1), Checks.forged(good, 12345, Integer.MAX_VALUE),
        Checks.forged(good, 12345, 1 << 20), new byte[0]};
    for (byte[] message : bad) {
      feed.accept(message);
      Checks.isTrue(said.next().startsWith("fault"), "a fault is said");
    }
    feed.accept(good);
    Checks.equal("shown 1", said.next());
    Checks.equal(4L, feed.counts().damaged);
    feed.close();
  }

  /** The feed counts what these throw; anything else would end its thread. */
  public static void mutilatedMessagesAreShownOrRefused() throws Exception {
    Random random = new Random(1);
    SkeletonMemory memory = new SkeletonMemory();
    int refused = 0;
    for (int i = 0; i < MUTILATIONS; ++i) {
      refused += isRefused(mutilated(PicturesTest.stereoMessage(), random),
          PicturePlugin::decode) ? 1 : 0;
      refused += isRefused(mutilated(BodiesTest.bodyMessage(), random),
          message -> BodyPlugin.decode(message, memory)) ? 1 : 0;
    }
    Checks.isTrue(refused > MUTILATIONS / 2, refused + " of them were refused");
  }

  private static boolean isRefused(byte[] message, ChannelFeed.Decoder<?> decoder) {
    try {
      decoder.decode(message);
      return false;
    } catch (DamagedMessage | IOException | RuntimeException | OutOfMemoryError error) {
      return true;
    }
  }

  /** Behind the fingerprint, some bytes are others and the end may be missing. */
  private static byte[] mutilated(byte[] message, Random random) {
    for (int i = 0; i < 3; ++i) {
      message[8 + random.nextInt(message.length - 8)] = (byte) random.nextInt();
    }
    return random.nextInt(4) > 0 ? message
        : Arrays.copyOf(message, 8 + random.nextInt(message.length - 8));
  }

  private static image_t image(int bytes) {
    image_t image = new image_t();
    image.width = 10;
    image.height = 10;
    image.row_stride = 10;
    image.pixelformat = image_t.PIXEL_FORMAT_GRAY;
    image.data = new byte[bytes];
    image.size = bytes;
    image.metadata = new image_metadata_t[0];
    return image;
  }

  private static void await(CountDownLatch latch) {
    try {
      Checks.isTrue(latch.await(WAIT_S, TimeUnit.SECONDS), "comes in time");
    } catch (InterruptedException error) {
      throw new IllegalStateException(error);
    }
  }

  /** Keeps what a feed shows. */
  private static final class Said implements ChannelFeed.Display<Object> {
    private final BlockingQueue<String> words = new LinkedBlockingQueue<>();

    @Override
    public void show(Object value) {
      words.add("shown " + value);
    }

    @Override
    public void showFault(String reason) {
      words.add("fault " + reason);
    }

    String next() throws InterruptedException {
      String word = words.poll(WAIT_S, TimeUnit.SECONDS);
      Checks.isTrue(word != null, "something is said in time");
      return word;
    }
  }
}
