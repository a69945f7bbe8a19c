// Which shots reach a lumel. The includer declares `Eye eyes[]` and `Shot shots[]`, and includes
// world/lumel.glsl and visibility/sees.glsl.

#include "nearfield/near_pairs.glsl"
#include "shooting/receiver.glsl"

// Does the light of shot k arrive, from the front and not through the near field? `d` leads from
// the shooter to the receiving point.
bool arrives(Receiver r, uint k, EyeViewLayout layout_, float near_radius, out vec3 d)
{
    d = r.x - eyes[k].position;
    return shots[k].lumel != r.lumel &&
           !is_near(r.centre, r.size, shots[k].centre, shots[k].size, near_radius) &&
           is_seen(r, k, layout_);
}
