// Latencies: how long after its sampling by the game server a frame is shown, by the clocks of two machines.

export const stepMs = 250;     // of which the greatest is kept
const maxAheadMs = 1000;       // by which the game server's clock may be ahead,
const maxLatencyMs = 600e3;    // and behind: of others the difference says nothing

// `sampled`, `shown`: ms since 1970. Null: the clocks do not agree.
export function latencyOf(sampled, shown) {
    const latency = shown - sampled;
    return latency > -maxAheadMs && latency < maxLatencyMs ? Math.max(latency, 0) : null;
}

// What of a latency is not the match's delay, which is intended.
export function lateMs(latency, delayMs) {
    return Math.max(latency - delayMs, 0);
}

export function latencyText(latency, delayMs) {
    return `latency ${Math.round(lateMs(latency, delayMs))} ms`;
}

// The greatest of each column of a picture of the times `from` to `to`, in ms, -1 where there is none.
// `latencies`: [{t, ms}], each of the stepMs from t on.
export function columnsOf(latencies, from, to, width) {
    const columns = new Float64Array(width).fill(-1);
    const scale = width / (to - from);
    for (const {t, ms} of latencies) {
        const first = Math.floor((t - from) * scale);
        const end = Math.max(Math.ceil((t + stepMs - from) * scale), first + 1);
        for (let i = Math.max(first, 0); i < Math.min(end, width); ++i) columns[i] = Math.max(columns[i], ms);
    }
    return columns;
}
