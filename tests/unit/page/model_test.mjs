import assert from 'node:assert/strict';
import {test} from 'node:test';
import {Model} from '../../../server/page/model.js';
import {kept} from '../../../server/page/playback.js';

function begun() {
    const model = new Model();
    model.begin(kept);
    return model;
}

const matchOf = (...players) => ({players: players.map(player => ({listed: true, ...player}))});
const ann = {slot: 0, id: 7, name: 'Ann', team: 1};
const bob = {slot: 1, id: 9, name: 'Bob', team: 2};
const carl = {slot: 2, id: 4, name: 'Carl', team: 2, listed: true};

test('a player looks as the match lists it', () => {
    const model = begun();
    model.setMatch(matchOf(ann, bob));
    assert.deepEqual([0, 1, null].map(slot => model.look(slot).name), ['Ann', 'Bob', 'nobody']);
    assert.deepEqual([0, 1, null].map(slot => model.look(slot).number), ['1', '2', '–']);
    assert.equal(new Set([0, 1, null].map(slot => model.look(slot).colour)).size, 3);
});

test('whom the match does not list looks as was last known', () => {
    const model = begun();
    model.setMatch(matchOf(ann, {slot: 2, id: 4, listed: false}));
    assert.equal(model.look(2).name, 'Player 4');
    assert.equal(model.look(1).name, 'nobody');
    model.setKnown([{...ann, name: 'Anna'}, {...bob, listed: true}, carl]);
    assert.deepEqual([0, 1, 2].map(slot => model.look(slot).name), ['Ann', 'Bob', 'Carl']);
    assert.equal(model.look(1).colour, model.look(2).colour, 'they are of one team');
    assert.notEqual(model.look(0).colour, model.look(1).colour);
    model.begin(kept);
    assert.equal(model.look(2).name, 'nobody', 'another match');
});

test('a look is made once, and anew when the match changes', () => {
    const model = begun();
    model.setMatch(matchOf(ann, bob));
    const look = model.look(0);
    assert.equal(model.look(0), look);
    model.setMatch(matchOf({...ann, name: 'Anna'}, bob));
    assert.equal(model.look(0).name, 'Anna');
});
