import assert from 'node:assert/strict';
import {test} from 'node:test';
import {Broadcast} from '../../../server/page/broadcast.js';
import {Model} from '../../../server/page/model.js';
import {kept, Playback} from '../../../server/page/playback.js';
import * as writer from './recording_writer.mjs';

const patienceMs = 20e3;

// A server of a recording, and a viewer of it whose clock the test moves.
class Stage {
    constructor(files, sync = {}) {
        this.files = files;
        const last = Math.max(...Object.keys(files).map(name => parseInt(name, 10)).filter(Number.isFinite));
        this.sync = {version: 1, recording: 'r', first_fragment: 0, last_fragment: last, fragment_duration_s: writer.durationMs / 1000,
            age_s: 0, delay_s: 0, live: false, ...sync};
        this.asked = [];
        this.status = 0;  // of every answer; 0: as it is
        this.told = [];
        this.problems = [];
        this.newest = 0;
        this.model = new Model();
        const broadcast = new Broadcast('http://cache/broadcast/m/sync', async (url, abort) => this.answer(url, abort));
        this.playback = new Playback(broadcast, this.model, {match: note => { this.told.push(note); this.model.setMatch(note); },
            problem: text => this.problems.push(text), token: () => this.told.push('token'), newest: () => { ++this.newest; },
            restart: () => this.told.push('restart')});
        this.now = performance.now();
    }

    answer(url, abort) {
        abort?.throwIfAborted();
        const name = new URL(url).pathname.replace('/broadcast/m/', '');
        this.asked.push(name);
        if (this.status) return new Response('', {status: this.status});
        if (name === 'sync') return new Response(JSON.stringify(this.sync));
        const bytes = this.files[name.replace('r/', '')];
        return bytes ? new Response(bytes) : new Response('Not Found', {status: 404});
    }

    // Moves the clock on by so much.
    play(ms) {
        this.playback.advance(this.now);
        for (const end = this.now + ms; this.now < end;) this.playback.advance(this.now = Math.min(this.now + 50, end));
    }

    async until(what, condition) {
        for (const end = Date.now() + patienceMs; !condition(); await new Promise(resolve => setTimeout(resolve, 2))) {
            this.play(0);
            if (Date.now() > end) throw new Error(`never: ${what}; ${this.playback.state} ${this.model.clock.t} ${this.problems}`);
        }
    }

    // Player 0 is at the number of the fragment.
    get shown() {
        return this.model.sample()?.players.get(0).position[0] ?? null;
    }
}

async function watch(files, use, {sync, begin = {t: 0}} = {}) {
    const stage = new Stage(files, sync);
    stage.playback.open(begin);
    try {
        await use(stage);
    } finally {
        stage.playback.close();
    }
}

test('a recording is played from its begin to its end, and all of its timeline is known', () =>
    watch(writer.recording(6), async stage => {
        await stage.until('begins', () => stage.shown === 0);
        assert.equal(stage.told[0].match_id, 'm');
        assert.deepEqual(stage.told[0].players.map(player => player.name), ['Ann', 'Bob']);
        assert.deepEqual(stage.playback.range, [0, 5001]);
        const {timeline, clock} = stage.model;
        await stage.until('the timeline', () => timeline.cuts.length === 6 && stage.playback.loaded.last === 5);
        assert.deepEqual(timeline.cuts.map(cut => [cut.t, cut.camera, cut.reason]), [0, 1, 2, 3, 4, 5].map(n => [n * 1000, 5, n === 0 ? 'begin' : 'viewpoint']));
        assert.equal(timeline.events.length, 6);
        assert.equal(timeline.events[2].detail, 'axe');
        stage.play(2500);
        assert.ok(Math.abs(clock.t - 2500) < 1, `${clock.t}`);
        assert.equal(stage.shown, 2, 'frames a second apart are not mixed');
        stage.play(9000);
        assert.equal(stage.playback.state, 'ended');
        assert.ok(clock.paused);
        assert.equal(stage.shown, 5);
        assert.deepEqual(stage.problems, []);
        assert.ok(stage.asked.length - new Set(stage.asked).size <= 1, `what is known is not fetched again: ${stage.asked}`);
    }));

test('the timeline has the latency with which frames were recorded, where they have a source time', async () => {
    await watch(writer.recording(4, undefined, 40), async stage => {
        const {timeline} = stage.model;
        await stage.until('the timeline', () => timeline.cuts.length === 4);
        assert.deepEqual(timeline.latencies, [0, 1, 2, 3].map(n => ({t: n * 1000, ms: 40})));
    });
    await watch(writer.recording(2), async stage => {
        const {timeline} = stage.model;
        await stage.until('the timeline', () => timeline.cuts.length === 2);
        assert.deepEqual(timeline.latencies, []);
    });
});

test('a seek fetches little, wherever it goes', () =>
    watch(writer.recording(400, n => n * 1015), async stage => {
        await stage.until('begins', () => stage.shown === 0);
        for (const n of [399, 7, 250, 251, 100, 0]) {
            const before = stage.asked.length;
            stage.playback.seek(n * 1015 + 20);
            stage.model.clock.setPaused(true);
            await stage.until(`at ${n}`, () => stage.shown === n);
            assert.ok(stage.asked.length - before < 30, `${stage.asked.length - before} requests`);
        }
        assert.deepEqual(stage.problems, []);
    }));

test('what is damaged, cut off or missing is told, and left out', () => {
    const files = writer.recording(10);
    files['2/delta'] = files['2/delta'].map((byte, i) => i === 40 ? byte ^ 1 : byte);
    files['3/delta'] = files['3/delta'].slice(0, -5);
    delete files['4/delta'];
    delete files['7/full'];
    return watch(files, async stage => {
        await stage.until('begins', () => stage.shown === 0);
        await stage.until('told', () => stage.problems.length === 3);
        assert.match(stage.problems[0], /^Damaged, left out: fragment 2, delta: byte 28: the checksum differs/);
        assert.match(stage.problems[1], /^Damaged, left out: fragment 3, delta: byte 24: .* bytes follow the header, expected/);
        assert.match(stage.problems[2], /^Missing, left out: fragment 4, delta: the server answers with 404/);
        await stage.until('loaded', () => stage.playback.loaded.last === 9);
        stage.play(1200);
        assert.equal(stage.shown, 5, 'playing goes on with what follows');
        stage.play(2000);
        assert.equal(stage.shown, 7, 'the state is known from the fragment before');
        stage.playback.seek(2500);
        await stage.until('behind the damage', () => stage.shown === 5 && stage.playback.state === 'playing');
    });
});

test('a seek into what is damaged goes on behind it, at the end before it', () => {
    const files = writer.recording(40);
    for (const n of [20, 21, 39]) files[`${n}/delta`] = new Uint8Array(3);
    return watch(files, async stage => {
        await stage.until('begins', () => stage.shown === 0);
        stage.playback.seek(20500);
        await stage.until('behind it', () => stage.shown === 22);
        stage.playback.seek(39900);
        await stage.until('before it', () => stage.shown === 38);
    });
});

test('where nothing was recorded, it goes on with what follows', () =>
    watch(writer.recording(8, n => n * 1000 + (n > 3 ? 60e3 : 0)), async stage => {
        await stage.until('begins', () => stage.shown === 0);
        stage.playback.seek(30e3);
        await stage.until('after the silence', () => stage.shown === 4);
        assert.ok(stage.model.clock.t >= 64e3);
        stage.playback.seek(3300);
        await stage.until('before the silence', () => stage.shown === 3);
        await stage.until('loaded', () => stage.playback.loaded.last === 4);
        stage.play(1000);
        assert.equal(stage.shown, 4);
    }));

test('a broadcast is watched at its newest, and followed', () =>
    watch(writer.recording(30), async stage => {
        await stage.until('begins', () => stage.playback.state === 'live' && stage.shown !== null);
        await stage.until('what there is', () => stage.playback.loaded.last === 20);
        assert.ok(stage.model.clock.t > 19e3 && stage.model.clock.t <= 20100, `${stage.model.clock.t}`);
        assert.ok(stage.asked.length < 12, `${stage.asked}`);
        stage.sync.last_fragment = 21;
        await stage.until('the next', () => stage.playback.loaded.last === 21);
        stage.sync.last_fragment = 19;
        const asked = stage.asked.length;
        await stage.until('another cache answers', () => stage.asked.length > asked);
        assert.equal(stage.playback.sync.last, 21, 'it knows less');
        stage.sync.last_fragment = 21;
        stage.playback.seek(2000);
        await stage.until('back', () => stage.shown === 2 && stage.playback.state === 'playing');
        stage.playback.goLive();
        await stage.until('live again', () => stage.shown >= 20 && stage.playback.state === 'live');
        stage.sync = {...stage.sync, last_fragment: 22, live: false};
        await stage.until('the last', () => stage.playback.loaded.last === 22);
        stage.play(6000);
        await stage.until('the end', () => stage.playback.state === 'ended');
        assert.deepEqual(stage.problems, []);
    }, {sync: {last_fragment: 20, live: true, age_s: 0.9}, begin: {}}));

test('a seek is followed also while the newest is being loaded', () =>
    watch(writer.recording(30), async stage => {
        await stage.until('begins', () => stage.shown === 2 && stage.playback.loaded.last > 10);
        const answer = stage.answer.bind(stage);
        stage.answer = (url, abort) => {
            const found = answer(url, abort);
            stage.answer = answer;
            stage.playback.seek(6000);
            stage.model.clock.setPaused(true);
            return found;
        };
        stage.playback.goLive();
        for (const end = Date.now() + 400; Date.now() < end; await new Promise(resolve => setTimeout(resolve, 5))) stage.play(0);
        assert.equal(stage.model.clock.t, 6000);
        assert.equal(stage.playback.state, 'paused');
        assert.equal(stage.shown, 6);
    }, {sync: {last_fragment: 20, live: true}, begin: {t: 2000}}));

// The page is hidden: nothing is drawn until the broadcast has gone on for long.
async function hideUntil(stage, change) {
    const asked = stage.asked.length;
    change();
    const isAsked = () => stage.asked.slice(asked).includes('sync');
    for (const end = Date.now() + patienceMs; !isAsked() && Date.now() < end;) await new Promise(resolve => setTimeout(resolve, 10));
    assert.ok(isAsked());
    await new Promise(resolve => setTimeout(resolve, 100));
}

test('a broadcast that was not drawn for long goes on with the newest, not with all that was missed', () =>
    watch(writer.recording(300), async stage => {
        await stage.until('begins', () => stage.playback.state === 'live' && stage.playback.loaded.last === 20);
        await hideUntil(stage, () => { stage.sync.last_fragment = 299; });
        stage.play(0);
        assert.equal(stage.playback.state, 'loading');
        await stage.until('newest', () => stage.playback.state === 'live' && stage.playback.loaded.last === 299);
        assert.ok(stage.model.clock.live && stage.asked.length < 70, `${stage.asked.length} requests`);
    }, {sync: {last_fragment: 20, live: true, age_s: 0.9}, begin: {}}));

test('a broadcast of which what was shown has been removed goes on with the newest', () =>
    watch(writer.recording(300), async stage => {
        await stage.until('begins', () => stage.playback.state === 'live' && stage.playback.loaded.last === 20);
        await hideUntil(stage, () => {
            Object.assign(stage.sync, {first_fragment: 250, last_fragment: 299});
            for (let n = 0; n < 250; ++n) for (const name of ['full', 'delta']) delete stage.files[`${n}/${name}`];
        });
        await stage.until('newest', () => stage.playback.state === 'live' && stage.playback.loaded.last === 299);
        assert.ok(stage.model.clock.live);
        assert.deepEqual(stage.problems, []);
    }, {sync: {last_fragment: 20, live: true, age_s: 0.9}, begin: {}}));

test('a broadcast whose newest fragments are damaged is asked for in no haste', () => {
    const files = writer.recording(21);
    for (let n = 16; n < 21; ++n) files[`${n}/full`] = new Uint8Array(1);
    return watch(files, async stage => {
        await stage.until('begins', () => stage.playback.state === 'live' && stage.model.buffer.last === 15e3);
        const asked = stage.asked.length;
        for (const end = Date.now() + 500; Date.now() < end; await new Promise(resolve => setTimeout(resolve, 5))) stage.play(0);
        assert.ok(stage.asked.length - asked < 5, `${stage.asked.length - asked} requests`);
    }, {sync: {live: true}, begin: {}});
});

test('the newest that can be read is shown, also where only what follows its begin is damaged', async () => {
    const files = writer.recording(10);
    files['9/delta'] = files['9/delta'].slice(0, -1);
    for (const live of [false, true])
        await watch(files, async stage => {
            await stage.until('begins', () => stage.model.buffer.last === 8e3);
            assert.match(stage.problems.join(), /^Damaged, left out: fragment 9, delta/);
        }, {sync: {live}, begin: {}});
});

test('who plays to the newest is told', () =>
    watch(writer.recording(30), async stage => {
        await stage.until('begins', () => stage.shown === 9);
        stage.model.clock.setSpeed(4);
        await stage.until('loaded', () => stage.playback.loaded.last === 10);
        stage.play(3000);
        assert.ok(stage.newest > 0);
    }, {sync: {last_fragment: 10, live: true}, begin: {t: 9000}}));

test('what is removed meanwhile is not waited for', () =>
    watch(writer.recording(200), async stage => {
        await stage.until('begins', () => stage.shown === 0);
        stage.model.clock.setPaused(true);
        stage.sync = {...stage.sync, first_fragment: 150};
        for (let n = 0; n < 150; ++n) for (const name of ['full', 'delta']) delete stage.files[`${n}/${name}`];
        stage.playback.seek(60500);
        await stage.until('the oldest that is kept', () => stage.shown === 150);
        assert.match(stage.problems.pop(), /no longer kept/);
        assert.equal(stage.playback.range[0], 150e3);
    }, {sync: {live: true}}));

test('more than the memory has room for is played without being fetched again', () =>
    watch(writer.recording(40), async stage => {
        stage.model.buffer.keptBytes = 6000;  // five frames
        await stage.until('begins', () => stage.shown === 0);
        await stage.until('the timeline', () => stage.model.timeline.cuts.length === 40);
        const asked = stage.asked.length;
        for (let n = 0; n < 30; ++n) {
            await stage.until(`what follows ${n}`, () => stage.playback.loaded.last > n + 1);
            assert.equal(stage.shown, n);
            assert.equal(stage.playback.state, 'playing');
            stage.play(1000);
        }
        assert.ok(stage.asked.length - asked < 70, `${stage.asked.length - asked} requests`);
        assert.ok(stage.model.buffer.frames.length < 8);
    }, {begin: {t: 100}}));

test('an ended broadcast that the server no longer has is not taken for one without fragments', () =>
    watch(writer.recording(40), async stage => {
        await stage.until('begins', () => stage.shown === 0);
        stage.model.clock.setPaused(true);
        await stage.until('what is ahead', () => stage.playback.loaded.last >= 14);
        stage.status = 404;
        stage.playback.seek(38e3);
        await stage.until('it knows', () => stage.playback.isGone);
        assert.deepEqual(stage.problems, ['The server no longer has this: only what is loaded can be seen']);
        assert.equal(stage.playback.state, 'ended');
        assert.equal(stage.playback.range[0], 0);
        stage.playback.seek(5e3);
        assert.equal(stage.shown, 5);
        assert.equal(stage.playback.state, 'paused');
        stage.status = 0;
        stage.playback.keepDue = 0;
        await stage.until('it is there again', () => !stage.playback.isGone);
        stage.playback.seek(38e3);
        await stage.until('and goes on', () => stage.shown === 38);
        assert.equal(stage.playback.unreadable.size, 0);
    }));

test('an ended broadcast is asked for now and then, so that the server keeps it', () =>
    watch(writer.recording(4), async stage => {
        await stage.until('begins', () => stage.shown === 0);
        stage.model.clock.setPaused(true);
        await stage.until('all there is', () => stage.model.timeline.cuts.length === 4 && stage.playback.loaded.last === 3);
        const asked = stage.asked.length;
        stage.playback.keepDue = 0;
        await stage.until('asked', () => stage.asked.length > asked);
        assert.deepEqual(stage.asked.slice(asked), ['sync']);
        assert.ok(stage.playback.keepDue > performance.now() + 60e3);
        stage.status = 404;
        stage.playback.keepDue = 0;
        await stage.until('asked again', () => stage.playback.keepDue > 0);
        assert.equal(stage.playback.state, 'paused', 'what is loaded is shown still');
        assert.equal(stage.problems.length, 1);
        stage.playback.keepDue = 0;
        await stage.until('asked once more', () => stage.playback.keepDue > 0);
        assert.equal(stage.problems.length, 1);
    }));

// Carl is in the match from fragment 3 on, followed there, and has left in fragment 5; Zoe is in the last one alone.
function ofManyPlayers() {
    const files = writer.recording(7);
    const at = n => ({ms: n * 1000, time: writer.begin + BigInt(n * 1000) * 1000000n});
    const content = (n, players, target) => [...writer.record(1, 0, writer.match({players})),
        ...writer.record(2, 0, writer.poses(n, at(n).ms * 1e6, n)),
        ...writer.record(6, 0, writer.cameras(n, at(n).ms * 1e6, n, {target})), ...writer.record(1, 1e6, writer.match({players}))];
    const all = {3: [[[0, 'Ann'], [8, 'Carl']], 8], 5: [[[0, 'Ann'], [1, 'Bob']], 0], 6: [[[9, 'Zoe'], [0, 'Ann']], 9]};
    for (const [n, [players, target]] of Object.entries(all))
        files[`${n}/delta`] = writer.resource(3, n, at(n).time, content(n, players, target));
    files['6/full'] = writer.resource(2, 6, at(6).time, content(6, all[6][0], 9));
    return files;
}

test('the timeline names players also where they are not in the match that is shown', () =>
    watch(ofManyPlayers(), async stage => {
        await stage.until('begins', () => stage.shown === 0);
        const {timeline} = stage.model;
        await stage.until('the timeline', () => stage.playback.surveyed.size === 7);
        stage.play(0);
        const nameAt = t => stage.model.look(timeline.spans(5, t, t + 1)[0].target).name;
        assert.deepEqual([0, 3000, 6000].map(nameAt), ['Ann', 'Carl', 'Zoe']);
        assert.deepEqual(stage.told[0].players.map(({slot, name}) => [slot, name]), [[0, 'Ann'], [1, 'Bob']],
            'slots are in the order in which players come');
        stage.playback.seek(6000);
        await stage.until('the end', () => stage.shown === 6);
        stage.play(0);
        assert.ok(stage.told.length > 1);
        assert.equal(nameAt(3000), 'Carl', 'who has left');
    }));

test('what is played is not counted as fetched for the timeline', () =>
    watch(writer.recording(40), async stage => {
        stage.playback.broadcast.bytes = 1e9;
        await stage.until('the timeline', () => stage.model.timeline.cuts.length === 40);
        assert.ok(stage.playback.surveyBytes > 0);
    }));

test('the timeline is fetched in less than half of the time, so that there is time to draw', () =>
    watch(writer.recording(60), async stage => {
        await stage.until('begins', () => stage.shown === 0);
        const {playback, model: {timeline}} = stage;
        const waits = [];
        const sleep = playback.sleep.bind(playback);
        playback.sleep = ms => {
            waits.push(ms);
            return sleep(Math.min(ms, 1));
        };
        const insert = timeline.insert.bind(timeline);
        timeline.insert = (...part) => {
            for (const end = performance.now() + 40; performance.now() < end;);
            insert(...part);
        };
        await stage.until('the timeline', () => timeline.cuts.length > 25);
        assert.ok(waits.filter(ms => ms > 80).length > 5, `${waits}`);
    }));

test('a server that does not answer is asked again', () =>
    watch(writer.recording(5), async stage => {
        stage.status = 503;
        await stage.until('it waits', () => stage.playback.state === 'waiting');
        stage.status = 401;
        await stage.until('it asks for a token', () => stage.told.includes('token'));
        stage.status = 0;
        await stage.until('begins', () => stage.shown === 0);
        assert.deepEqual(stage.problems, []);
    }));

test('another recording of the match is begun anew', () =>
    watch(writer.recording(5), async stage => {
        await stage.until('begins', () => stage.playback.state === 'live');
        stage.sync.recording = 'other';
        await stage.until('it restarts', () => stage.told.includes('restart'));
    }, {sync: {live: true}, begin: {}}));

test('what another recording of the match does not have is not told as missing', () =>
    watch(writer.recording(40), async stage => {
        await stage.until('begins', () => stage.shown === 0);
        stage.sync.recording = 'other';
        for (let n = 0; n < 40; ++n) delete stage.files[`${n}/delta`];
        stage.playback.seek(30e3);
        await stage.until('it restarts', () => stage.told.includes('restart'));
        await new Promise(resolve => setTimeout(resolve, 50));
        assert.deepEqual(stage.problems, ['Another recording of this match has begun']);
    }));

test('a recording of which nothing can be read says so, and is not asked for in haste', () => {
    const files = writer.recording(5);
    for (let n = 0; n < 5; ++n) files[`${n}/full`] = new Uint8Array(1);
    return watch(files, async stage => {
        await stage.until('told', () => stage.problems.some(text => /^No fragment of this recording can be read/.test(text)));
        assert.equal(stage.playback.state, 'waiting');
        assert.ok(stage.asked.length < 20);
    });
});

test('answers are not read beyond what a resource may have', async () => {
    const endless = new ReadableStream({pull: controller => controller.enqueue(new Uint8Array(1 << 20))});
    const broadcast = new Broadcast('http://cache/broadcast/m/sync', async () => new Response(endless));
    await assert.rejects(broadcast.sync(), /sync: more than 4096 bytes/);
});

test('what a closed playback was reading changes nothing', async () => {
    for (const last of ['0/full', '0/delta', '1/delta']) {
        const stage = new Stage(writer.recording(6));
        const {model, playback} = stage;
        let told = -1;
        const answer = stage.answer.bind(stage);
        stage.answer = (url, abort) => {
            const found = answer(url, abort);
            if (told < 0 && new URL(url).pathname.endsWith(last))
                queueMicrotask(() => {
                    playback.close();
                    model.begin(kept);  // as the next source does
                    told = stage.told.length;
                });
            return found;
        };
        playback.open({t: 0});
        for (const end = Date.now() + patienceMs; told < 0 && Date.now() < end; await new Promise(resolve => setTimeout(resolve, 2))) stage.play(0);
        await new Promise(resolve => setTimeout(resolve, 100));
        assert.equal(stage.told.length, told, `${last} was answered`);
        assert.deepEqual(model.timeline.cuts, []);
        assert.deepEqual(model.buffer.frames, []);
    }
});
