// Light that a lumel has not sent on yet. The includer declares Surface, Emission, Far, Near and
// Shot arrays.

// B_i - B_i^s = E + ρ H - B^s
vec3 unshot_of(uint i)
{
    return emission[i] + surface[i].rgb * (far[i] + near[i]) - shot[i];
}
