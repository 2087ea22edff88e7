-- For wrk: viewers of the matches whose `sync` its arguments are the paths of, each followed by its recording's id. They
-- read there which fragment is the newest, and ask for that.
local sync_every = 32
local matches, match_of, asked = {}, {}, 0

function init(args)
    for i = 1, #args, 2 do
        local match = {sync = wrk.format("GET", args[i]), folder = args[i]:gsub("sync$", args[i + 1])}
        table.insert(matches, match)
        match_of[args[i + 1]] = match
    end
end

function request()
    asked = asked + 1
    local match = matches[math.floor(asked / sync_every) % #matches + 1]
    if asked % sync_every == 0 then return match.sync end
    return match.newest or match.sync
end

-- Of what is no `sync` only the status matters.
function response(status, headers, body)
    if status ~= 200 or body:byte(1) ~= 123 then return end
    local match = match_of[body:match('"recording":"([^"]+)"')]
    local last = body:match('"last_fragment":(%d+)')
    if match and last then match.newest = wrk.format("GET", match.folder .. "/" .. last .. "/delta") end
end

function done(summary, latency)
    local errors = summary.errors
    print(string.format("result requests=%d seconds=%.3f bytes=%d p99_us=%d failed=%d", summary.requests,
        summary.duration / 1e6, summary.bytes, latency:percentile(99),
        errors.connect + errors.read + errors.write + errors.status + errors.timeout))
end
