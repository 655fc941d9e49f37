package deixis.spy;

import java.util.ArrayList;
import java.util.Map;
import java.util.TreeMap;
import kinect.skeleton_msg_t;

/** Gathers skeleton messages, one person each, into all people of the last second. */
final class SkeletonMemory {
  private static final long KEEP_US = 1_000_000;

  private final Map<Integer, Figure> people = new TreeMap<>();
  private final Map<Integer, Long> utimes = new TreeMap<>();

  /** All people that are there with this message; one more than MAX_PEOPLE is refused. */
  Figures with(skeleton_msg_t message) throws DamagedMessage {
    Figure figure = Figures.of(message);
    // Times ahead of this one are of a clock that jumped, or of a replay that began anew.
    utimes.values().removeIf(utime -> Math.abs(message.utime - utime) > KEEP_US);
    people.keySet().retainAll(utimes.keySet());
    if (people.size() >= Figures.MAX_PEOPLE && !people.containsKey(message.user_id)) {
      throw new DamagedMessage("is of more than " + Figures.MAX_PEOPLE + " people at once");
    }
    people.put(message.user_id, figure);
    utimes.put(message.user_id, message.utime);
    return new Figures("", new ArrayList<>(people.values()));
  }
}
