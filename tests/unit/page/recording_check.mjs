// recording_check.mjs FOLDER EXPECTED.json: the page reads of a recording what its writer's reader and the live stream have
// of it. Run by tests/unit/live/page_test.cpp, which writes both.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {Roster, apply, readFragment, readState} from '../../../server/page/fragment.js';
import {decodeResource, decodeStart, decodeSync} from '../../../server/page/recording.js';

const [folder, expectedFile] = process.argv.slice(2);
const file = name => new Uint8Array(readFileSync(`${folder}/${name}`));
const expected = JSON.parse(readFileSync(expectedFile, 'utf8'));
const sorted = notes => [...notes].sort((a, b) => a.t - b.t);

function sameTimes(found, wanted) {
    assert.equal(found.length, wanted.length);
    found.forEach(({t}, i) => assert.ok(Math.abs(t - wanted[i].t) < 0.01, `${t} is not ${wanted[i].t}`));
    assert.deepEqual(found.map(note => ({...note, t: 0})), wanted.map(note => ({...note, t: 0})));
}

const start = decodeStart((await decodeResource(file('start'), 'start', 0, 'start')).content, 'start');
assert.equal(start.match.matchId, expected.match_id);
assert.equal(start.fragmentDuration, expected.fragment_duration);
const {first, last} = decodeSync(JSON.stringify({...JSON.parse(readFileSync(`${folder}/sync`, 'utf8')), recording: 'r',
    fragment_duration_s: start.fragmentDuration / 1e9}), 'sync');
assert.ok(last > 5);

const roster = new Roster();
const {beginTime: origin} = await readState(file(`${first}/full`), first);
const all = {frames: [], cuts: [], events: [], matches: []};
let {state} = await readState(file(`${first}/full`), first);
for (let n = first; n <= last; ++n) {
    const begin = await readState(file(`${n}/full`), n);
    assert.deepEqual({...state, poses: 0}, {...begin.state, poses: 0}, `full of ${n} follows from what is before it`);
    for (const player of state.poses?.players ?? [])
        assert.deepEqual(begin.state.poses.players.find(({id}) => id === player.id), player);
    const known = Object.assign(new Roster(), {players: new Map(roster.players)});
    const fragment = await readFragment(file(`${n}/delta`), n, state, origin, roster);
    assert.equal(fragment.from, Number(begin.beginTime - origin) / 1e6);
    // Decoded alone it is the same.
    assert.deepEqual({...await readFragment(file(`${n}/delta`), n, begin.state, origin, known), matches: 0, state: 0}, {...fragment, matches: 0, state: 0});
    for (const list of ['frames', 'cuts', 'events', 'matches']) all[list].push(...fragment[list]);
    state = fragment.state;
}

assert.equal(all.frames.length, expected.frames.length);
all.frames.forEach((frame, i) => {
    const wanted = expected.frames[i];
    assert.ok(Math.abs(frame.t - wanted.t) < 0.01, `${frame.t} is not ${wanted.t}`);
    assert.equal(frame.number, wanted.number);
    assert.equal(frame.sourceTime, wanted.source_time_ms);
    assert.deepEqual([...frame.players.values()], wanted.players, 'every bit of a float is kept');
    assert.deepEqual([...frame.cameras.values()], wanted.cameras);
    assert.deepEqual([...frame.movers].map(([id, pose]) => ({id, ...pose})), wanted.movers);
    assert.deepEqual(frame.moverList, wanted.mover_list);
});
sameTimes(sorted(all.cuts), sorted(expected.notes.filter(note => note.kind === 'cut')));
sameTimes(sorted(all.events), sorted(expected.notes.filter(note => note.kind === 'event')));

// Each change of the players is told when it is in the stream.
const changes = notes => notes.map(({epoch, map, players}) => ({epoch, map, players}))
    .filter((note, i, all) => JSON.stringify(note) !== JSON.stringify(all[i - 1]));
assert.deepEqual(changes(all.matches.map(({note}) => note)), changes(expected.notes.filter(note => note.kind === 'match')));
assert.deepEqual(apply(state, {}), state, 'what the page does not show changes nothing');
