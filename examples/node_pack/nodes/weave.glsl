// Crossing threads: each cell shows the warp (along v) or the weft (along u),
// rounded across, lowest at its edges.

struct Thread {
    bool is_warp;
    float across;  // -1 at one edge of the thread, 1 at the other
};

Thread thread_at(vec2 cell, vec2 within, int pattern)
{
    // Plain: every other cell. Twill: pairs that shift by one a row.
    float period = pattern == 0 ? 2.0 : 4.0;
    float place = mod(cell.x + cell.y, period);
    Thread thread;
    thread.is_warp = place < 0.5 * period;
    thread.across = 2.0 * (thread.is_warp ? within.x : within.y) - 1.0;
    return thread;
}

void pack_weave(vec2 texcoord, float threads, int pattern, vec3 warp, vec3 weft,
                out vec3 color, out float height)
{
    vec2 p = texcoord * max(threads, 1.0);
    Thread thread = thread_at(floor(p), fract(p), pattern);
    height = sqrt(max(1.0 - thread.across * thread.across, 0.0));
    color = thread.is_warp ? warp : weft;
    color *= 0.4 + 0.6 * height;
}
