// Sums of ChartLight over a workgroup, in an order that never changes.

ChartLight no_light()
{
    return ChartLight(0.0, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
}

ChartLight sum_of(ChartLight a, ChartLight b)
{
    return ChartLight(a.power + b.power, a.unshot + b.unshot, a.shot + b.shot,
                      a.arrived + b.arrived, a.reflected + b.reflected);
}

shared ChartLight shared_light[kProgressiveGroup];

ChartLight add_over_group(ChartLight mine)
{
    const uint me = gl_LocalInvocationID.x;
    shared_light[me] = mine;
    barrier();
    for (uint width = kProgressiveGroup / 2u; width > 0u; width /= 2u) {
        if (me < width)
            shared_light[me] = sum_of(shared_light[me], shared_light[me + width]);
        barrier();
    }
    return shared_light[0];
}
