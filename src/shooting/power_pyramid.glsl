// Drawing a lumel with probability proportional to its power: [BSS05] section 4.1, with 32
// children to a node instead of 4. The lumels lie in Morton order within charts, so a
// stratified u gives shooters that are spread over the surfaces.

struct Drawn {
    uint lumel;
    float probability;  // p_j; 0: there is no power at all
};

#define DRAW_FROM(pyramid, u_)                                                                     \
    {                                                                                              \
        const uint top = layout_.levels - 1u;                                                      \
        const float total = pyramid[layout_.first[top]];                                           \
        float rest = u_ * total;                                                                   \
        uint node = 0u;                                                                            \
        for (uint level = top; level-- > 0u;) {                                                    \
            uint child = node * kPyramidFanout;                                                    \
            const uint last = min(child + kPyramidFanout, layout_.count[level]) - 1u;              \
            float weight = pyramid[layout_.first[level] + child];                                  \
            while (child < last && rest >= weight) {                                               \
                rest -= weight;                                                                    \
                weight = pyramid[layout_.first[level] + ++child];                                  \
            }                                                                                      \
            node = child;                                                                          \
        }                                                                                          \
        drawn = Drawn(node, total > 0.0 ? pyramid[layout_.first[0] + node] / total : 0.0);         \
    }
