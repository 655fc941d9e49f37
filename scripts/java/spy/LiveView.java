package deixis.spy;

import java.awt.Color;
import java.awt.Graphics;
import java.awt.Graphics2D;
import java.awt.RenderingHints;
import javax.swing.JComponent;

/** Shows the newest value; above it, when the newest message was damaged, why. */
abstract class LiveView<T> extends JComponent implements ChannelFeed.Display<T> {
  static final Color BACKGROUND = new Color(24, 26, 30);
  static final Color TEXT = new Color(220, 222, 226);
  static final Color FAULT = new Color(200, 30, 40);
  private static final long serialVersionUID = 1L;

  private transient volatile T shown;
  private volatile String fault;

  @Override
  public void show(T value) {
    shown = value;
    fault = null;
    repaint();
  }

  @Override
  public void showFault(String reason) {
    fault = reason;
    repaint();
  }

  /** Paints a value into the whole component. */
  abstract void draw(Graphics2D graphics, T value);

  @Override
  protected void paintComponent(Graphics graphics) {
    Graphics2D copy = (Graphics2D) graphics.create();
    copy.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_ON);
    copy.setColor(BACKGROUND);
    copy.fillRect(0, 0, getWidth(), getHeight());
    T value = shown;
    if (value != null) {
      draw(copy, value);
    } else if (fault == null) {
      copy.setColor(TEXT);
      copy.drawString("nothing has arrived yet", 10, 20);
    }
    drawFault(copy, fault);
    copy.dispose();
  }

  private void drawFault(Graphics2D graphics, String reason) {
    if (reason == null) {
      return;
    }
    int height = graphics.getFontMetrics().getHeight() + 8;
    graphics.setColor(FAULT);
    graphics.fillRect(0, 0, getWidth(), height);
    graphics.setColor(Color.WHITE);
    graphics.drawString("damaged: " + reason, 10, height - 8);
  }
}
