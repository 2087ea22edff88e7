import assert from 'node:assert/strict';
import {test} from 'node:test';
import {cameraFlag} from '../../../server/page/protocol.js';
import {modeOf, modeText, reasonText} from '../../../server/page/timeline_view.js';

const names = ['Ann', 'Bob'];
const nameOf = slot => names[slot];

test('a cut of a pinned shot says what the camera did', () => {
    assert.equal(reasonText({reason: 'hidden'}, nameOf), 'the player was out of sight');
    assert.equal(reasonText({reason: 'something new'}, nameOf), 'something new');
});

test('a cut of an automatic shot says which moment it shows, and of whom', () => {
    const cut = (actor, subject) => ({reason: 'target', moment: {rule: 'duel', actor, subject}});
    assert.equal(reasonText(cut(0, 1), nameOf), 'duel, Ann and Bob');
    assert.equal(reasonText(cut(1, null), nameOf), 'duel, Bob');
    assert.equal(reasonText(cut(null, null), nameOf), 'duel');
});

test('a shot of nobody is a fixed camera, unless its player is absent', () => {
    assert.equal(modeOf({target: null, flags: 0}), 'fixed');
    assert.equal(modeOf({target: null, flags: cameraFlag.absent}), 'absent');
    assert.equal(modeOf({target: 3, flags: 0}), 'hidden');
    assert.equal(modeOf({target: 3, flags: cameraFlag.visible}), 'visible');
});

test('what a shot of a group does is of all of them', () => {
    const shot = flags => ({target: 0, flags});
    assert.equal(modeText(shot(cameraFlag.visible), false), 'In view');
    assert.equal(modeText(shot(cameraFlag.visible), true), 'All living in view');
    assert.equal(modeText(shot(cameraFlag.searching), true), 'Not all in view');
    assert.equal(modeText(shot(cameraFlag.absent), true), 'Absent');
});
