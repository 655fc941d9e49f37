import deixis.candidate_t;
import deixis.gesture_t;
import java.io.IOException;
import java.util.Locale;
import lcm.lcm.LCM;
import lcm.lcm.LCMDataInputStream;

/**
 * Prints every recognised gesture: what it is, which object is meant, and how probable that is.
 *
 * <pre>java -Djava.net.preferIPv4Stack=true -cp /usr/share/java/lcm.jar:build/release/java/deixis_types.jar \
 *     scripts/java/examples/PrintGestures.java [CHANNEL]</pre>
 *
 * Listens where LCM_DEFAULT_URL says; the channel is GESTURES unless told otherwise.
 */
public class PrintGestures {
    public static void main(String[] arguments) throws Exception {
        LCM bus = new LCM();
        bus.subscribe(arguments.length > 0 ? arguments[0] : "GESTURES", PrintGestures::print);
        Thread.currentThread().join(); // LCM receives in a thread of its own
    }

    private static void print(LCM bus, String channel, LCMDataInputStream data) {
        try {
            gesture_t gesture = new gesture_t(data);
            if (gesture.end_utime != 0) return; // told again because it has ended
            System.out.println(gesture.name + ": " + outcome(gesture) + "; candidates: " + candidates(gesture));
        } catch (IOException error) {
            System.err.println(channel + ": not a gesture_t: " + error.getMessage());
        }
    }

    private static String outcome(gesture_t gesture) {
        switch (gesture.outcome) {
            case gesture_t.OBJECT: return gesture.object_label;
            case gesture_t.NO_OBJECT: return "no known object";
            case gesture_t.AMBIGUOUS: return "one of several";
            default: return "unknown outcome";
        }
    }

    private static String candidates(gesture_t gesture) {
        StringBuilder text = new StringBuilder();
        for (candidate_t candidate : gesture.candidates) {
            text.append(text.length() > 0 ? ", " : "").append(String.format(Locale.ROOT, "%s (object %d, %.2f)",
                candidate.label, candidate.object_id, candidate.probability));
        }
        return text.length() > 0 ? text.toString() : "none";
    }
}
