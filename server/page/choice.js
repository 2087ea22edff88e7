// What the viewer watches as the list of what there is to watch changes. Pure.

const maxMissed = 5;           // lists in a row without the stream that is watched: it is gone
export const maxRefusals = 3;  // of a stream in a row that is in the list: the server has no room

// Whether the server serves as many viewers as it may. `entry`: of the match that is watched, or undefined.
export function isFull(entry, refusals) {
    return Boolean(entry?.stream) && refusals >= maxRefusals;
}

// {id, from} of what is to be watched from now on, from: 'newest' of its stream, or 'broadcast' of what is shown now; null:
// what is watched. `matches`: the list. `now`: {id: of what is watched or null, isRecorded, hasEnded, isOpen: the stream
// runs, missed: lists in a row that did not have the stream, refusals}.
// A list may lack a match that goes on, of a server that is busy or has just begun.
export function choose(matches, now) {
    const entry = matches.find(({id}) => id === now.id);
    const begin = id => ({id, from: 'newest'});
    if (now.id === null) {
        const first = matches.find(({stream}) => stream?.shots.length > 0) ?? matches.find(({goesOn}) => goesOn) ?? matches[0];
        return first ? begin(first.id) : null;
    }
    if (now.isRecorded) return now.hasEnded && entry?.goesOn && !entry.stream ? begin(entry.id) : null;  // another one begins
    if (isFull(entry, now.refusals) && entry.sync) return {id: entry.id, from: 'broadcast'};
    if (!now.hasEnded && (entry?.stream || now.isOpen || now.missed < maxMissed)) return null;
    if (entry?.stream) return begin(entry.id);
    const other = matches.find(({stream}) => stream);
    return other ? begin(other.id) : null;
}
