// Colours that people with any colour vision can tell apart (after Okabe and Ito), for a dark background.
// A number or a shape always says the same.

const hues = ['#56b4e9', '#e69f00', '#2fc296', '#f0e442', '#d884b5', '#e8743b', '#7d9bff', '#c9c9c9'];
const teams = {1: '#e8743b', 2: '#56b4e9', 3: '#f0e442', 4: '#2fc296'};

// `players`: of a match. In teams, where there are at least two.
export function colourOf(player, players) {
    const inMatch = new Set(players.filter(other => other.listed).map(other => other.team));
    if (inMatch.size > 1 && teams[player?.team]) return teams[player.team];
    return hues[(player?.slot ?? 7) % hues.length];
}

export function nameOf(player) {
    if (!player) return 'nobody';
    // Quake's colour codes are no part of a name.
    const name = (player.name ?? '').replace(/\^[0-9a-zA-Z]/g, '').trim();
    return name || `Player ${player.id}`;
}
