#define SQUARE(x) ((x) * (x))
struct band { vec2 edges; vec3 tint; };
float ramp(float x, vec2 edges) { return smoothstep(edges.x, edges.y, x); }
void bands(vec2 at, band how, int count, out vec3 color, out float mask)
{
    float sum = 0.0;
    for (int i = 0; i < count; i++) {
        if (SQUARE(at.x) > float(i) * 0.1) sum += ramp(fract(at.y * float(i + 1)), how.edges);
        else break;
    }
    mask = sum / float(max(count, 1));
    color = how.tint * mask;
}
