#include "solve/matrix/multiply.h"

namespace lumel {
namespace {

using AnyForm = std::variant<MultiplyTiles, MultiplyBc1>;

AnyForm form_of(const gpu::Device& device, const CompressedMatrix& matrix, std::uint32_t states)
{
    if (const auto* bc1 = std::get_if<Bc1Matrix>(&matrix))
        return AnyForm(std::in_place_type<MultiplyBc1>, device, *bc1, states);
    return AnyForm(std::in_place_type<MultiplyTiles>, device, std::get<TiledMatrix>(matrix),
                   states);
}

}  // namespace

Multiply::Multiply(const gpu::Device& device, const CompressedMatrix& matrix, std::uint32_t states)
    : form_(form_of(device, matrix, states))
{
}

void Multiply::record(gpu::Commands& commands, const gpu::Array<glm::vec3>& x,
                      const gpu::Array<glm::vec3>& y, std::uint32_t states)
{
    std::visit([&](auto& form) { form.record(commands, x, y, states); }, form_);
}

}  // namespace lumel
