// A match's stream as the page takes it, from a server of which only the WebSocket is made up.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {test} from 'node:test';
import {LiveSource} from '../../../server/page/live_source.js';
import {Model} from '../../../server/page/model.js';

class Socket {
    static OPEN = 1;
    static made = [];

    constructor(url, protocols) {
        if (protocols.some(protocol => /[^\w.%~!'*-]/.test(protocol))) throw new SyntaxError('as browsers do');
        Socket.made.push(this);
        this.readyState = 0;
    }

    open() {
        this.readyState = Socket.OPEN;
        this.onopen();
    }

    note(content) {
        this.onmessage({data: JSON.stringify(content)});
    }

    close() {}
}

globalThis.WebSocket = Socket;
globalThis.location = {protocol: 'http:', host: 'here'};

const newest = () => Socket.made[Socket.made.length - 1];
// `listed`: how many of them the game server lists still.
const matchOf = (players, {epoch = 1, listed = players.length} = {}) => ({kind: 'match', version: 1, match_id: 'cup', epoch, map: 'hall', metres_per_unit: 0.0254,
    position_step: 0.01, rate_hz: 60, players: players.map((id, slot) => ({slot, id, listed: slot < listed, name: `p${id}`}))});

// `told`: what it has told.
function stream(token = () => null) {
    const model = new Model();
    const told = [];
    const tell = what => () => told.push(what);
    const source = new LiveSource('cup', model, token,
        {begin: tell('begin'), match: tell('match'), problem: text => told.push(text), change() {}});
    return {model, source, told};
}

// As if frames had come.
function fill(model) {
    for (const t of [0, 16, 32]) model.buffer.add(t, 100, () => ({t, players: new Map(), cameras: new Map(), movers: new Map()}));
}

test('who joins or leaves changes nothing of what is kept', () => {
    const {model, source} = stream();
    newest().open();
    newest().note(matchOf([7, 9]));
    fill(model);
    newest().note(matchOf([7, 9, 11]));
    newest().note(matchOf([7, 9, 11], {listed: 1}));
    assert.equal(model.buffer.last, 32);
    source.close();
});

test('frames are forgotten when a server that was started again has given their slots to others', () => {
    const {model, source} = stream();
    newest().open();
    newest().note(matchOf([7, 9]));
    fill(model);
    for (const restarted of [[9, 7], [7]]) {
        fill(model);
        newest().note(matchOf(restarted));
        assert.equal(model.buffer.last, null, `${restarted}`);
        assert.equal(model.players.get(0).id, restarted[0]);
        newest().note(matchOf([7, 9]));
    }
    source.close();
});

test('a server that does not open the stream has refused, until it opens it or does not answer at all', () => {
    const {source} = stream();
    newest().onclose();
    assert.equal(source.refusals, 1);
    source.link.open();
    newest().onclose();
    assert.equal(source.refusals, 2);
    source.unreachable();
    assert.equal(source.refusals, 0);
    source.link.open();
    newest().open();
    newest().onclose();
    assert.equal(source.refusals, 0, 'it was open');
    source.close();
});

// A frame without players and cameras.
function frameOf(t, sourceTimeMs) {
    const view = new DataView(new ArrayBuffer(28));
    view.setUint8(0, 1);
    view.setBigInt64(12, BigInt(t) * 1_000_000n, true);
    view.setBigInt64(20, BigInt(Math.round(sourceTimeMs)) * 1_000_000n, true);
    return {data: view.buffer};
}

test('the timeline has the latency of frames as they arrive, where the clocks agree', () => {
    const {model, source} = stream();
    newest().open();
    newest().note(matchOf([]));
    newest().note({kind: 'history', states: [], notes: []});
    newest().onmessage(frameOf(0, Date.now() - 60e3));
    assert.equal(model.timeline.latencyAt(0), null, 'the one that follows a history may be old');
    newest().onmessage(frameOf(1000, Date.now() - 40));
    const latency = model.timeline.latencyAt(1000);
    assert.ok(latency >= 40 && latency < 30e3, `${latency}`);
    newest().onmessage(frameOf(2000, Date.now() + 500));
    assert.equal(model.timeline.latencyAt(2000), 0, 'a clock may be a little ahead');
    newest().onmessage(frameOf(3000, Date.now() + 3600e3));
    assert.equal(model.timeline.latencyAt(3000), null);
    assert.equal(source.age, null);
    source.close();
});

const door = {id: 3, name: '*1', kind: 'func_door', hulls: [], balls: [[0, 0, 0, 1]]};

test('a frame has the movers of the last note before it, and those of another epoch are forgotten', () => {
    const golden = readFileSync(new URL('../live/frame.hex', import.meta.url), 'utf8').trim();
    const {model, source} = stream();
    newest().open();
    newest().note(matchOf([7, 9]));
    newest().note({kind: 'history', states: [], notes: []});
    newest().note({kind: 'movers', movers: [door]});
    newest().onmessage({data: Uint8Array.from(golden.match(/../g), byte => parseInt(byte, 16)).buffer});
    const {moverList, movers} = model.buffer.sample(1500);
    assert.deepEqual(moverList, [door]);
    assert.ok(movers.has(3));
    newest().note(matchOf([7, 9], {epoch: 2}));
    assert.deepEqual(source.movers, []);
    source.close();
});

test('movers that are not as they should be are told and left out', () => {
    const {source, told} = stream();
    newest().open();
    newest().note(matchOf([7, 9]));
    newest().note({kind: 'movers', movers: [door]});
    told.length = 0;
    for (const bad of [undefined, {}, [null], [{...door, hulls: undefined}], [{...door, balls: [[0, 0, 1]]}]])
        newest().note({kind: 'movers', movers: bad});
    assert.deepEqual(told, Array(5).fill('What moves in the map cannot be read'));
    assert.deepEqual(source.movers, [door]);
    source.close();
});

test('another epoch, and other players in the same slots, are told as a begin before their match', () => {
    const {source, told} = stream();
    newest().open();
    newest().note(matchOf([7, 9]));
    newest().note(matchOf([7, 9, 11]));
    assert.deepEqual(told.splice(0), ['match', 'match'], 'what is shown goes on');
    newest().note(matchOf([7, 9, 11], {epoch: 2}));
    assert.deepEqual(told.splice(0), ['begin', 'match']);
    newest().note(matchOf([9, 7], {epoch: 2}));
    assert.deepEqual(told, ['begin', 'match']);
    source.close();
});

test('of a server of another version nothing more is taken, and it is not asked again', () => {
    const {model, source, told} = stream();
    const socket = newest();
    socket.open();
    socket.note({...matchOf([7, 9]), version: 2});
    assert.equal(source.state, 'outdated');
    socket.onmessage(frameOf(0, Date.now()));
    assert.equal(model.buffer.last, null);
    source.link.unreachable();
    source.runs();
    assert.equal(newest(), socket);
    assert.deepEqual(told, ['The server speaks another version: reload this page']);
    source.close();
});

// In the place of setTimeout, until restore().
class Timers {
    constructor() {
        this.before = {setTimeout, clearTimeout};
        this.now = 0;
        this.due = new Map();
        globalThis.setTimeout = (call, ms) => {
            const id = Symbol('timer');
            this.due.set(id, {call, at: this.now + ms});
            return id;
        };
        globalThis.clearTimeout = id => this.due.delete(id);
    }

    tick(ms) {
        this.now += ms;
        for (const [id, {call, at}] of this.due) if (at <= this.now && this.due.delete(id)) call();
    }

    restore() {
        Object.assign(globalThis, this.before);
    }
}

test('a stream that is silent while its match runs is opened again', () => {
    const timers = new Timers();
    try {
        const {source} = stream();
        const socket = newest();
        socket.open();
        socket.note(matchOf([]));
        source.runs();
        timers.tick(11e3);
        source.runs();
        assert.equal(source.state, 'empty', 'it is not silent yet');
        timers.tick(1e3);
        assert.equal(source.state, 'silent');
        timers.tick(60e3);
        assert.equal(newest(), socket, 'the match may stand still');
        source.runs();
        assert.equal(source.state, 'waiting');
        timers.tick(1e3);
        assert.notEqual(newest(), socket);
        source.close();
    } finally {
        timers.restore();
    }
});

test('a token that no stream can be asked for with is asked with again, and a better one then', () => {
    const timers = new Timers();
    try {
        const made = Socket.made.length;
        let token = 'a(b';
        const {source} = stream(() => token);
        assert.equal(source.state, 'waiting');
        timers.tick(10e3);
        assert.equal(Socket.made.length, made);
        token = 'ab';
        timers.tick(20e3);
        assert.equal(Socket.made.length, made + 1);
        source.close();
    } finally {
        timers.restore();
    }
});
