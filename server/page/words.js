// Times and states in words.

export function seconds(ms) {
    return `${(ms / 1000).toFixed(1)} s`;
}

// 75.5 s: 1:15; with tenths 1:15.5.
export function clockText(ms, tenths = true) {
    const whole = Math.floor(Math.max(ms, 0) / 1000);
    const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
    const two = number => String(number).padStart(2, '0');
    const text = h > 0 ? `${h}:${two(m)}:${two(s)}` : `${m}:${two(s)}`;
    return tenths ? `${text}.${Math.floor(Math.max(ms, 0) / 100) % 10}` : text;
}

// What the source does: [state, text]. `facts`: {retryInMs, known: whether there is a match already, isFull: the server takes
// no more viewers, entry: the match's state in the list, behindMs: behind what is newest, lateMs: behind the game or null}.
export function stateText(state, {retryInMs, known, isFull, entry, behindMs, lateMs}) {
    const texts = {
        none: () => ['empty', 'No match'],
        outdated: () => ['outdated', 'Another version: reload this page'],
        connecting: () => ['connecting', known ? 'Reconnecting' : 'Connecting'],
        waiting: () => ['waiting', `${isFull ? 'No room for another viewer: trying again' : 'Reconnecting'} in ${
            Math.max(1, Math.round(retryInMs / 1000))} s`],
        opening: () => ['connecting', 'Opening'],
        loading: () => ['loading', 'Loading'],
        ended: () => ['ended', 'Ended'],
        silent: () => ['silent', entry ? `No frames: ${entry}` : 'No frames'],
        empty: () => ['empty', entry ?? 'No frames yet'],
        paused: () => ['paused', behindMs === null ? 'Paused' : `Paused, ${seconds(behindMs)} behind`],
        behind: () => ['behind', `${seconds(behindMs)} behind`],
        playing: () => ['behind', behindMs === null ? 'Recording' : `Recording, ${clockText(behindMs, false)} behind`],
        live: () => ['live', `Live · ${seconds(lateMs ?? behindMs)} after the game`],
    };
    return texts[state]();
}
