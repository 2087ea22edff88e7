// When the fragments of a recording are, as far as it is known: which one has a time.

// By which a time may be beside a fragment.
export const slackMs = 400;

export class FragmentIndex {
    // `durationMs`: about that long is a fragment that is not known.
    constructor(durationMs) {
        this.durationMs = durationMs;
        this.known = new Map();  // by number: {from, to} in ms; `to` where it was read
    }

    add(n, from, to) {
        this.known.set(n, {from, to});
    }

    // The fragment at a time, of those from `first` to `last`. When it is read and added, and has the time, the answer
    // stays the same; else the answer comes nearer.
    locate(t, first, last) {
        let before = null;
        let after = null;
        for (const [n, {from, to}] of this.known) {
            if (from <= t && (!before || n > before.n)) before = {n, from, to};
            if (from > t && (!after || n < after.n)) after = {n, from};
        }
        if (!before) return first;
        const within = n => Math.min(Math.max(n, first), last);
        const isPast = before.to !== undefined && t > before.to + slackMs;
        if (before.to !== undefined && !isPast) return within(before.n);
        const each = after ? (after.from - before.from) / (after.n - before.n) : this.durationMs;
        const least = before.n + (isPast ? 1 : 0);
        const most = after ? Math.max(after.n - 1, least) : Infinity;
        return within(Math.min(Math.max(before.n + Math.floor((t - before.from) / each), least), most));
    }

    // When a fragment begins. At least one must be known.
    beginOf(n) {
        let nearest = null;
        for (const [known, {from}] of this.known)
            if (!nearest || Math.abs(known - n) < Math.abs(nearest.n - n)) nearest = {n: known, from};
        return nearest.from + (n - nearest.n) * this.durationMs;
    }

    endOf(n) {
        return this.known.get(n)?.to ?? this.beginOf(n) + this.durationMs;
    }
}
