#include "solve/matrix/multiply.h"

namespace lumel {
namespace {

using AnyForm = std::variant<MultiplyCoded, MultiplyLowRank, MultiplyTiles>;

struct MakeForm {
    const gpu::Device& device;
    std::uint32_t states;

    AnyForm operator()(const CodedMatrix& matrix) const
    {
        return AnyForm(std::in_place_type<MultiplyCoded>, device, matrix, states);
    }
    AnyForm operator()(const LowRankMatrix& matrix) const
    {
        return AnyForm(std::in_place_type<MultiplyLowRank>, device, matrix, states);
    }
    AnyForm operator()(const TiledMatrix& matrix) const
    {
        return AnyForm(std::in_place_type<MultiplyTiles>, device, matrix, states);
    }
};

}  // namespace

Multiply::Multiply(const gpu::Device& device, const CompressedMatrix& matrix, std::uint32_t states)
    : form_(std::visit(MakeForm{device, states}, matrix))
{
}

void Multiply::record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                      const gpu::Array<glm::vec3>& y, std::uint32_t states)
{
    std::visit([&](auto& form) { form.record(commands, x, y, states); }, form_);
}

}  // namespace lumel
