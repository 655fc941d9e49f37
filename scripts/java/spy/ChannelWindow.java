package deixis.spy;

import java.awt.BorderLayout;
import java.awt.Window;
import java.awt.event.ActionEvent;
import java.awt.event.WindowAdapter;
import java.awt.event.WindowEvent;
import java.util.function.Supplier;
import java.util.regex.Pattern;
import javax.swing.AbstractAction;
import javax.swing.JDesktopPane;
import javax.swing.JLabel;
import javax.swing.SwingUtilities;
import javax.swing.Timer;
import lcm.lcm.LCM;
import lcm.spy.ChannelData;

/**
 * Fills a window of lcm-spy with the view of one channel and a line of counts below it. It has a
 * subscription of its own, so that it outlives lcm-spy's "Clear"; it ends it with the window.
 */
final class ChannelWindow<T> {
  private static final int COUNT_EVERY_MS = 500;

  private final String channel;
  private final ChannelFeed<T> feed;
  private final JLabel status = new JLabel(" ");
  private final Timer timer = new Timer(COUNT_EVERY_MS, event -> tell());
  private long lastReceived;
  private long lastNanos = System.nanoTime();

  private ChannelWindow(String channel, ChannelFeed<T> feed) {
    this.channel = channel;
    this.feed = feed;
  }

  /** The entry of lcm-spy's menu; it asks for the name of one without a channel, too. */
  static <T> AbstractAction action(String name, JDesktopPane desktop, ChannelData channel,
      Supplier<LiveView<T>> view, ChannelFeed.Decoder<T> decoder) {
    return new AbstractAction(name) {
      private static final long serialVersionUID = 1L;

      @Override
      public void actionPerformed(ActionEvent event) {
        LiveView<T> live = view.get();
        new ChannelWindow<>(channel.name, new ChannelFeed<>(decoder, live)).open(desktop, live);
      }
    };
  }

  private void open(JDesktopPane desktop, LiveView<T> view) {
    desktop.setLayout(new BorderLayout());
    desktop.add(view, BorderLayout.CENTER);
    desktop.add(status, BorderLayout.SOUTH);
    feed.start("deixis " + channel);
    LCM.getSingleton().subscribe(Pattern.quote(channel), feed);
    timer.start();
    Window window = SwingUtilities.getWindowAncestor(desktop);
    window.addWindowListener(new WindowAdapter() {
      @Override
      public void windowClosing(WindowEvent event) {
        close(window);
      }
    });
    window.pack();
  }

  private void close(Window window) {
    timer.stop();
    LCM.getSingleton().unsubscribe(Pattern.quote(channel), feed);
    feed.close();
    window.dispose();
  }

  private void tell() {
    ChannelFeed.Counts counts = feed.counts();
    long now = System.nanoTime();
    double rate = (counts.received - lastReceived) * 1e9 / Math.max(1, now - lastNanos);
    lastReceived = counts.received;
    lastNanos = now;
    status.setText(String.format(" %s: %d messages, %.1f Hz, %d skipped, %d damaged", channel,
        counts.received, rate, counts.skipped, counts.damaged));
  }
}
