// What is asked of the server, with the token where it wants one.

const key = 'camera-director-token';
const limitMs = 20e3;

// A link may carry `#token=...&match=...`: what follows # is never sent. The token leaves the address bar.
function takeFromAddress() {
    const given = new URLSearchParams(location.hash.slice(1));
    const token = given.get('token');
    if (token) {
        sessionStorage.setItem(key, token);
        given.delete('token');
        history.replaceState(null, '', `${location.pathname}#${given}`);
    }
    return given.get('match');
}

export const matchOfAddress = takeFromAddress();

export function rememberMatch(matchId) {
    history.replaceState(null, '', `${location.pathname}#${new URLSearchParams({match: matchId})}`);
}

export function token() {
    return sessionStorage.getItem(key);
}

export function setToken(value) {
    sessionStorage.setItem(key, value);
}

export function ask(path) {
    const given = token();
    return fetch(path, {headers: given ? {Authorization: `Bearer ${given}`} : {}, signal: AbortSignal.timeout(limitMs)});
}

// The map's picture; null with a reason where there is none.
export async function model(map, file) {
    for (let attempt = 0; attempt < 30; ++attempt) {
        const answer = await ask(`/map/${encodeURIComponent(map)}/${file}`);
        if (answer.ok) return {file: await answer.arrayBuffer()};
        if (answer.status !== 503) return {file: null, reason: (await answer.text()).trim()};
        await new Promise(resolve => setTimeout(resolve, 1000));
    }
    return {file: null, reason: 'the server is busy'};
}
