// What there is to watch: the streams of this page's server, and what it or a cache broadcasts.
import {Refused} from './broadcast.js';
import * as server from './server.js';

async function json(url) {
    const answer = await server.ask(url);
    if (!answer.ok) throw new Refused(url, answer.status);
    return answer.json();
}

// [{id, map, stream: the entry of /live or null, sync: URL or null, goesOn: whether more follows}].
export async function findMatches() {
    const isAlone = server.broadcastOfAddress !== null;
    const {matches: streams, broadcast} = isAlone ? {matches: [], broadcast: server.broadcastOfAddress} : await json('/live');
    const list = broadcast === undefined ? null : new URL(broadcast, location.href);
    // Streams are watched although the list of broadcasts cannot be had.
    const broadcasts = list === null ? [] : (await json(list).catch(error => {
        if (isAlone) throw error;
        return {matches: []};
    })).matches;
    const found = new Map(streams.map(stream =>
        [stream.match_id, {id: stream.match_id, map: stream.map, stream, sync: null, goesOn: true}]));
    for (const {match, map, live, sync} of broadcasts) {
        const known = found.get(match) ?? {id: match, map, stream: null, goesOn: live};
        found.set(match, {...known, sync: new URL(sync, list).href});
    }
    return [...found.values()];
}
