// The five faces of a hemicube [CG85].

// Frame of a face: `axis` looks at its centre, `right` and `up` span it. On side faces `up` is
// the normal and only the half above the horizon exists.
struct Face {
    vec3 right;
    vec3 up;
    vec3 axis;
};

Face hemicube_face(Eye eye, uint face)
{
    switch (face) {
    case 0u: return Face(eye.tangent, eye.bitangent, eye.normal);
    case 1u: return Face(eye.bitangent, eye.normal, eye.tangent);
    case 2u: return Face(eye.bitangent, eye.normal, -eye.tangent);
    case 3u: return Face(eye.tangent, eye.normal, eye.bitangent);
    default: return Face(eye.tangent, eye.normal, -eye.bitangent);
    }
}

// A point as the eye sees it through one face: 90° frustum, reversed z, far at infinity. A side
// face shows only 0 ≤ up / w ≤ 1.
vec4 through_face(Eye eye, uint index, float near, vec3 position)
{
    const Face face = hemicube_face(eye, index);
    const vec3 d = position - eye.position;
    const float w = dot(d, face.axis);
    const float up = dot(d, face.up);
    return vec4(dot(d, face.right), index == 0u ? up : 2.0 * up - w, near, w);
}
