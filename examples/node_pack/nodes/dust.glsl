// The surface of the Moon: dark grains that light meets once. The law of Lommel and Seeliger
// (H. von Seeliger 1888; M. B. Fairbairn, "Planetary Photometry: The Lommel-Seeliger Law",
// JRASC 99, 2005), for grains that scatter alike in all directions. `color` is the part of the
// light that a grain does not absorb. A full moon is as bright at its rim as in its middle.

vec3 pack_dust_evaluate(vec3 wo, vec3 wi, vec3 color)
{
    return color * (wi.z / (4.0 * M_PI * (wi.z + wo.z)));
}

// All of the hemisphere alike.
vec3 pack_dust_sample(vec3 wo, vec2 xi, vec3 color)
{
    float r = sqrt(1.0 - xi.x * xi.x);
    float turn = 2.0 * M_PI * xi.y;
    return vec3(r * cos(turn), r * sin(turn), xi.x);
}

float pack_dust_pdf(vec3 wo, vec3 wi, vec3 color)
{
    return 0.5 / M_PI;
}

// The integral of what evaluate gives, exactly.
vec3 pack_dust_albedo(vec3 wo, vec3 color)
{
    float mu = max(wo.z, 1e-6);
    return 0.5 * color * (1.0 - mu * log((1.0 + mu) / mu));
}
