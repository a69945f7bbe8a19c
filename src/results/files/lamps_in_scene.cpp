#include "results/files/lamps_in_scene.h"

#include "results/files/gzip.h"
#include "results/files/half_map.h"

namespace lumel {

void add_lamps(GlbBuilder& builder, const Pages& pages, std::span<const SceneLamp> lamps)
{
    Json list = Json::array();
    for (const SceneLamp& lamp : lamps)
        list.push_back({{"name", lamp.name},
                        {"kind", lamp.kind},
                        {"members", lamp.members},
                        {"color", json_array(lamp.color)},
                        {"error", lamp.error},
                        {"brightest", Json::array()}});
    std::vector<std::uint8_t> bytes;
    HalfMap half;
    for (int page = 0; page < pages.count; ++page)
        for (std::size_t k = 0; k < lamps.size(); ++k) {
            half = half_map(cut_page(pages, page, *lamps[k].map));
            list[k]["brightest"].push_back(shortest(half.brightest));
            bytes.insert(bytes.end(), half.bytes.begin(), half.bytes.end());
        }
    const std::size_t view = builder.add_view(gzip(bytes), ViewTarget::none);
    extras_of(builder.json["asset"])["lumel"]["lamps"] = {{"list", std::move(list)},
                                                          {"width", half.width},
                                                          {"height", half.height},
                                                          {"bufferView", view}};
}

}  // namespace lumel
