package deixis.spy;

import java.io.IOException;
import lcm.lcm.LCM;
import lcm.lcm.LCMDataInputStream;
import lcm.lcm.LCMSubscriber;

/**
 * Messages of one channel, the newest first and the rest skipped: what arrives while one is being
 * decoded waits in a place for one. Decodes in a thread of its own; counts what became of all.
 */
final class ChannelFeed<T> implements LCMSubscriber {
  /** Turns the bytes of a message into what is shown. */
  interface Decoder<T> {
    T decode(byte[] message) throws IOException, DamagedMessage;
  }

  /** Takes what was decoded, and reasons why something was not; in the feed's thread. */
  interface Display<T> {
    void show(T value);

    void showFault(String reason);
  }

  /** What became of the messages so far. */
  static final class Counts {
    final long received;
    final long skipped;
    final long damaged;

    Counts(long received, long skipped, long damaged) {
      this.received = received;
      this.skipped = skipped;
      this.damaged = damaged;
    }
  }

  private final Decoder<T> decoder;
  private final Display<T> display;
  private byte[] waiting;
  private boolean isClosed;
  private long received;
  private long skipped;
  private long damaged;

  ChannelFeed(Decoder<T> decoder, Display<T> display) {
    this.decoder = decoder;
    this.display = display;
  }

  /** Starts the thread; it ends after close(). */
  void start(String name) {
    Thread thread = new Thread(this::work, name);
    thread.setDaemon(true);
    thread.start();
  }

  @Override
  public void messageReceived(LCM lcm, String channel, LCMDataInputStream stream) {
    byte[] message = new byte[stream.available()];
    try {
      stream.readFully(message);
    } catch (IOException error) {
      throw new IllegalStateException("a message is shorter than it says", error);
    }
    accept(message);
  }

  synchronized void accept(byte[] message) {
    ++received;
    if (waiting != null) {
      ++skipped;
    }
    waiting = message;
    notifyAll();
  }

  synchronized Counts counts() {
    return new Counts(received, skipped, damaged);
  }

  synchronized void close() {
    isClosed = true;
    notifyAll();
  }

  private void work() {
    for (byte[] message = next(); message != null; message = next()) {
      try {
        display.show(decoder.decode(message));
      } catch (DamagedMessage | IOException error) {
        note(error.getMessage());
      } catch (RuntimeException | OutOfMemoryError error) {
        // Generated code believes every length that it reads: negative, and gigabytes, too.
        note("lengths do not fit: " + error.getMessage());
      }
    }
  }

  private void note(String reason) {
    synchronized (this) {
      ++damaged;
    }
    display.showFault(reason);
  }

  /** Waits for a message; null when closed. */
  private synchronized byte[] next() {
    try {
      while (waiting == null && !isClosed) {
        wait();
      }
    } catch (InterruptedException error) {
      return null;
    }
    byte[] message = isClosed ? null : waiting;
    waiting = null;
    return message;
  }
}
