// What the shaders of every solver need.

const float kPi = 3.14159265358979;

// Luminance of linear Rec. 709 (CIE Y).
float luminance(vec3 c)
{
    return dot(c, vec3(0.2126, 0.7152, 0.0722));
}
