// What has just happened, in words.
import {shownEvents} from './protocol.js';

const shownMs = 6000;
const maxShown = 4;
const verbs = {kill: 'fragged', 'flag taken': 'took the', 'flag captured': 'captured the', objective: 'reached',
    award: 'earned', round: 'round'};

function withoutUnderscores(name) {
    return name.replace(/_/g, ' ');
}

export class Feed {
    // `look(slot)`: {name, colour} of a player.
    constructor(list, look) {
        this.list = list;
        this.look = look;
        this.shown = '';
    }

    show(events, t) {
        const recent = events.filter(event => shownEvents.has(event.event) && event.t <= t && t - event.t < shownMs).slice(-maxShown);
        const key = recent.map(event => `${event.t} ${event.event} ${event.subject}`).join();
        if (key === this.shown) return;
        this.shown = key;
        this.list.replaceChildren(...recent.map(event => {
            const item = document.createElement('li');
            item.append(...this.words(event));
            return item;
        }));
    }

    words({event, actor, subject, detail}) {
        if (event === 'kill' && (actor === null || actor === subject)) return [this.name(subject), ' died'];
        const words = [];
        if (actor !== null) words.push(this.name(actor), ' ');
        words.push(verbs[event], ' ');
        if (subject !== null) words.push(this.name(subject), ' ');
        if (event !== 'kill') words.push(withoutUnderscores(detail));
        return words;
    }

    name(slot) {
        const {name, colour} = this.look(slot);
        const element = document.createElement('b');
        element.textContent = name;
        element.style.color = colour;
        return element;
    }
}
