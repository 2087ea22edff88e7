// A fragment of a recording as the model takes it: frames, cuts with their reasons, events, the match.
import {latencyOf} from './latency.js';
import {cameraFlag, playerFlag} from './protocol.js';
import {decodeRecords, decodeResource} from './recording.js';

const maxJitterMs = 100;    // by which a record may be off its frame's time
const maxEventAgeMs = 5e3;  // by which an event may be older than its record
const least = 1e-3;         // ms between frames
const eventNames = ['kill', 'flag taken', 'flag captured', 'objective', 'damage', 'award', 'item', 'round', 'spawn', 'weapon'];

// Players' slots, which they keep, and their names, also where a match does not list them.
export class Roster {
    constructor() {
        this.players = new Map();  // by id: what the note has of them
        this.known = new Map();    // by slot: as they were listed last, by the match's time; else without a name
        this.listedAt = new Map(); // by slot: when that was
    }

    // Null: nobody, or nobody who was ever listed or seen.
    slotOf(id) {
        return this.players.get(id)?.slot ?? null;
    }

    // Returns whether there is somebody new.
    add(ids) {
        const before = this.players.size;
        for (const id of ids) {
            if (this.players.has(id)) continue;
            const player = {slot: this.players.size, id, listed: false};
            this.players.set(id, player);
            this.known.set(player.slot, player);
        }
        return this.players.size > before;
    }

    // The match's note of idl/live.md. `t`: since when the match is so, in ms of the model.
    note(match, t) {
        this.add(match.players.map(({id}) => id));
        for (const [id, {slot}] of this.players) this.players.set(id, {slot, id, listed: false});
        for (const {id, name, class: kind, team} of match.players) {
            const player = {slot: this.slotOf(id), id, listed: true, name, class: kind, team};
            this.players.set(id, player);
            this.keep(player, t);
        }
        return {kind: 'match', match_id: match.matchId, epoch: String(match.epoch), map: match.map, metres_per_unit: match.metresPerUnit,
            rate_hz: match.rateHz, players: [...this.players.values()].map(player => ({...player}))};
    }

    // Fragments are read in any order.
    keep(player, t) {
        if (this.listedAt.get(player.slot) > t) return;
        this.listedAt.set(player.slot, t);
        this.known.set(player.slot, player);
    }
}

// The match after some records: {match, poses, cameras, moverList, moved}, each null or empty or the last record's, and where
// the movers of the list are, by id; the poses that `full` has are also those of players whom the last record has not.
export const noState = {match: null, poses: null, cameras: null, moverList: null, moved: [], movers: new Map()};

// Those of a list, where they were before or are in these records.
function placedMovers({moverList, movers}, placed) {
    const ids = new Set((moverList?.movers ?? []).map(({id}) => id));
    const all = [...movers, ...placed.map(({id, position, rotation}) => [id, {position, rotation}])];
    return new Map(all.filter(([id]) => ids.has(id)));
}

export function apply(state, record) {
    if (record.match) {
        const {match} = state;
        const goesOn = match === null || match.epoch === record.match.epoch && match.map === record.match.map;
        return {...(goesOn ? state : noState), match: record.match};
    }
    if (record.poses) return {...state, poses: record.poses};
    if (record.cameras) return {...state, cameras: record.cameras};
    if (record.moverList) return {...state, moverList: record.moverList, movers: placedMovers({...state, ...record}, state.moved)};
    if (record.moverPoses) return {...state, moved: record.moverPoses.movers, movers: placedMovers(state, record.moverPoses.movers)};
    return state;
}

// The state at the begin of fragment n.
export async function readState(bytes, n) {
    const name = `fragment ${n}, full`;
    const {beginTime, content} = await decodeResource(bytes, 'full', n, name);
    return {beginTime, state: decodeRecords(content, name).reduce(apply, noState)};
}

const noPlayer = 0xffffffff;
const isFixed = ({target, flags}) => target === noPlayer && !(flags & cameraFlag.absent);

function reasonOf(before, now, poses) {
    if (!before) return 'begin';
    if (before.target !== now.target || isFixed(now)) return 'target';
    const followed = poses.players.find(player => player.id === now.target);
    if (followed && followed.flags & playerFlag.discontinuity) return 'moved';
    return before.flags & cameraFlag.visible ? 'viewpoint' : 'hidden';
}

// The cuts of a frame, as server/live/history.cpp has them.
export function cutsOf(before, cameras, poses, slotOf) {
    const shots = new Map((before?.cameras ?? []).map(camera => [camera.id, camera]));
    const cuts = [];
    for (const camera of cameras.cameras) {
        const last = shots.get(camera.id);
        if (last && !(camera.flags & cameraFlag.cut)) continue;
        const reason = reasonOf(last, camera, poses);
        const cut = {kind: 'cut', camera: camera.id, target: slotOf(camera.target), reason};
        const told = cameras.reasons.find(other => other.camera === camera.id);
        // Told again once a second, so of a cut only with a new target.
        if (told && (reason === 'begin' || reason === 'target'))
            cut.moment = {rule: told.rule, actor: slotOf(told.actor), subject: slotOf(told.subject)};
        cuts.push(cut);
    }
    return cuts;
}

function eventNote({event, actor, subject, value, detail}, slotOf) {
    return {kind: 'event', event: eventNames[event - 1] ?? event, actor: slotOf(actor), subject: slotOf(subject), value, detail};
}

function frameOf({poses, moverList, movers}, cameras, slotOf) {
    const players = poses.players.map(({id, flags, position, rotation}) => [slotOf(id), {slot: slotOf(id), flags, position, rotation}]);
    const shots = cameras.cameras.map(camera => [camera.id, {...camera, target: slotOf(camera.target)}]);
    return {number: poses.number, epoch: poses.epoch, sourceTime: Number(poses.sourceTime / 1000n) / 1e3,
        players: new Map(players), cameras: new Map(shots), movers, moverList: moverList?.movers ?? []};
}

function median(values) {
    return [...values].sort((a, b) => a - b)[values.length >> 1];
}

// From the game's clock, which runs evenly, to the recording's, whose records are as late as they were taken: by epoch
// the difference in ms.
function clockOffsets(records) {
    const differences = new Map();
    for (const {at, frame} of records) {
        if (!frame) continue;
        if (!differences.has(frame.epoch)) differences.set(frame.epoch, []);
        differences.get(frame.epoch).push(at - Number(frame.frameTime) / 1e6);
    }
    return new Map([...differences].map(([epoch, all]) => [epoch, median(all)]));
}

// The game's time of a record by the recording's clock, where it is within [at - before, at + after].
function timeOf({epoch, frameTime}, at, offsets, before, after) {
    if (!offsets.has(epoch)) return at;
    const t = Number(frameTime) / 1e6 + offsets.get(epoch);
    return t >= at - before && t <= at + after ? t : at;
}

// Decodes `delta` of fragment n, which follows on `state`. `origin`: ns, the recording's time that is 0 ms of the model.
// Returns {n, from, to, frames, cuts, events, matches: [{t, note}], state: at its end}.
export async function readFragment(bytes, n, state, origin, roster) {
    const name = `fragment ${n}, delta`;
    const {beginTime, content} = await decodeResource(bytes, 'delta', n, name);
    const from = Number(beginTime - origin) / 1e6;
    const slotOf = id => roster.slotOf(id);
    const fragment = {n, from, to: from, frames: [], cuts: [], events: [], matches: []};
    const records = decodeRecords(content, name).map(record => ({...record, at: from + record.after, frame: record.cameras}));
    const offsets = clockOffsets(records);
    const beginMs = Number(beginTime / 1000n) / 1e3;
    const tellMatch = (t, match) => fragment.matches.push({t, note: roster.note(match, t)});
    roster.add((state.poses?.players ?? []).map(({id}) => id));
    if (state.match) tellMatch(from, state.match);
    let last = -Infinity;
    for (const record of records) {
        const {at, match, poses, event, cameras} = record;
        fragment.to = Math.max(fragment.to, at);
        if (match) tellMatch(at, match);
        if (poses && roster.add(poses.players.map(({id}) => id)) && state.match) tellMatch(at, state.match);
        if (event) fragment.events.push({...eventNote(event, slotOf), t: timeOf(event, at, offsets, maxEventAgeMs, maxJitterMs)});
        if (cameras && state.poses) {
            const t = Math.max(timeOf(cameras, at, offsets, maxJitterMs, maxJitterMs), last + least);
            last = t;
            for (const cut of cutsOf(state.cameras, cameras, state.poses, slotOf)) fragment.cuts.push({...cut, t});
            const frame = frameOf(state, cameras, slotOf);
            fragment.frames.push({...frame, t, latency: latencyOf(frame.sourceTime, beginMs + record.after)});
        }
        state = apply(state, record);
    }
    fragment.to = Math.max(fragment.to, last);
    return {...fragment, state};
}
