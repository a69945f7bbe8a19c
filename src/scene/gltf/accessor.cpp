#include "scene/gltf/accessor.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace lumel {

namespace {

/// More elements than any real mesh; count × size cannot overflow.
constexpr std::int64_t kLargestCount = std::int64_t(1) << 40;
/// Limit for accessors without data, which are zeros: a small file must not allocate gigabytes.
constexpr std::int64_t kLargestImplicitCount = std::int64_t(1) << 24;
constexpr std::int64_t kLargestOffset = std::int64_t(1) << 50;

struct ElementType {
    const char* name;
    std::size_t rows;
    std::size_t columns;
};
constexpr std::array<ElementType, 7> kElementTypes = {{
    {"SCALAR", 1, 1},
    {"VEC2", 2, 1},
    {"VEC3", 3, 1},
    {"VEC4", 4, 1},
    {"MAT2", 2, 2},
    {"MAT3", 3, 3},
    {"MAT4", 4, 4},
}};

/// Equally spaced elements in a buffer.
struct Run {
    const std::uint8_t* first = nullptr;
    std::size_t stride = 0;
};

struct SparseLayout {
    std::size_t count = 0;
    ComponentType index_type = ComponentType::u32;
    Run indices;
    Run values;
};

/// An accessor, resolved to memory.
struct AccessorLayout {
    AccessorData head;  ///< all but the bytes
    Run run;            ///< zeros if `first` is null
    std::optional<SparseLayout> sparse;
};

std::size_t component_size(ComponentType type)
{
    switch (type) {
    case ComponentType::i8:
    case ComponentType::u8:
        return 1;
    case ComponentType::i16:
    case ComponentType::u16:
        return 2;
    case ComponentType::u32:
    case ComponentType::f32:
        break;
    }
    return 4;
}

ComponentType component_type_of(const JsonView& view)
{
    const std::int64_t value = view.integer(INT64_MIN, INT64_MAX);
    for (ComponentType type : {ComponentType::i8, ComponentType::u8, ComponentType::i16,
                               ComponentType::u16, ComponentType::u32, ComponentType::f32})
        if (value == static_cast<std::int64_t>(type))
            return type;
    view.fail("is " + std::to_string(value) + ", which is no glTF component type");
}

AccessorData head_of(const JsonView& view)
{
    AccessorData head;
    head.component_type = component_type_of(view.get("componentType"));
    head.count = static_cast<std::size_t>(view.get("count").integer(1, kLargestCount));
    head.normalized = view.boolean_or("normalized", false);
    const JsonView type = view.get("type");
    const auto* known = std::find_if(kElementTypes.begin(), kElementTypes.end(),
                                     [&](const ElementType& t) { return t.name == type.string(); });
    if (known == kElementTypes.end())
        type.fail("is " + quoted(type.string()) + ", which is no glTF element type");
    head.type = known->name;
    head.components = known->rows * known->columns;

    // Columns of matrices start at multiples of four bytes.
    std::size_t column_size = known->rows * component_size(head.component_type);
    if (known->columns > 1)
        column_size = (column_size + 3) / 4 * 4;
    head.element_size = column_size * known->columns;
    return head;
}

std::int64_t offset_of(const JsonView& view)
{
    const auto offset = view.find("byteOffset");
    return offset ? offset->integer(0, kLargestOffset) : 0;
}

/// Memory of `count` elements of `element_size` bytes that `view` (accessor, sparse.indices or
/// sparse.values) describes. The bufferViews are already checked.
Run run_of(const GltfDocument& document, const JsonView& view, std::size_t count,
           std::size_t element_size, bool may_interleave)
{
    const JsonView root = document.root();
    const JsonView index = view.get("bufferView");
    const std::size_t which = index.index(root.count("bufferViews"), "bufferViews");
    const JsonView buffer_view = root.get("bufferViews").at(which);

    Run run;
    run.stride = element_size;
    if (const auto stride = buffer_view.find("byteStride")) {
        if (!may_interleave)
            view.fail("must not use a bufferView with a byteStride");
        run.stride = static_cast<std::size_t>(stride->integer(0, INT32_MAX));
        if (run.stride < element_size)
            view.fail("has elements of " + std::to_string(element_size) +
                      " bytes, but its bufferView has a byteStride of " +
                      std::to_string(run.stride));
    }

    const std::int64_t offset = offset_of(view);
    const std::int64_t length = buffer_view.get("byteLength").integer(0, kLargestOffset);
    const std::int64_t needed = offset + static_cast<std::int64_t>((count - 1) * run.stride) +
                                static_cast<std::int64_t>(element_size);
    if (needed > length)
        view.fail("needs " + std::to_string(needed) + " bytes of bufferView " +
                  std::to_string(which) + ", which has " + std::to_string(length));
    const auto buffer = static_cast<std::size_t>(buffer_view.get("buffer").integer(0, INT32_MAX));
    run.first = document.buffers[buffer].data() + offset_of(buffer_view) + offset;
    return run;
}

std::uint32_t unsigned_at(const std::uint8_t* bytes, ComponentType type)
{
    switch (component_size(type)) {
    case 1:
        return *bytes;
    case 2: {
        std::uint16_t value;
        std::memcpy(&value, bytes, sizeof value);
        return value;
    }
    default: {
        std::uint32_t value;
        std::memcpy(&value, bytes, sizeof value);
        return value;
    }
    }
}

bool is_unsigned(ComponentType type)
{
    return type == ComponentType::u8 || type == ComponentType::u16 || type == ComponentType::u32;
}

SparseLayout sparse_of(const GltfDocument& document, const JsonView& view, const AccessorData& head)
{
    SparseLayout sparse;
    sparse.count = static_cast<std::size_t>(
        view.get("count").integer(1, static_cast<std::int64_t>(head.count)));
    const JsonView indices = view.get("indices");
    sparse.index_type = component_type_of(indices.get("componentType"));
    if (!is_unsigned(sparse.index_type))
        indices.get("componentType").fail("sparse indices must be unsigned whole numbers");
    sparse.indices =
        run_of(document, indices, sparse.count, component_size(sparse.index_type), false);
    sparse.values = run_of(document, view.get("values"), sparse.count, head.element_size, false);

    std::int64_t previous = -1;
    for (std::size_t i = 0; i < sparse.count; ++i) {
        const std::uint32_t index =
            unsigned_at(sparse.indices.first + i * sparse.indices.stride, sparse.index_type);
        if (index >= head.count)
            indices.fail("index " + std::to_string(i) + " is " + std::to_string(index) +
                         ", but the accessor has " + std::to_string(head.count) + " elements");
        if (index <= previous)
            indices.fail("are not strictly increasing at index " + std::to_string(i));
        previous = index;
    }
    return sparse;
}

AccessorLayout layout_of(const GltfDocument& document, const JsonView& view)
{
    AccessorLayout layout;
    layout.head = head_of(view);
    if (view.find("bufferView"))
        layout.run = run_of(document, view, layout.head.count, layout.head.element_size, true);
    else if (layout.head.count > static_cast<std::size_t>(kLargestImplicitCount))
        view.get("count").fail("is " + std::to_string(layout.head.count) +
                               ", too many for an accessor without a bufferView");
    if (const auto sparse = view.find("sparse"))
        layout.sparse = sparse_of(document, *sparse, layout.head);
    return layout;
}

template <typename T>
float normalized_float(T value)
{
    // KHR_mesh_quantization and core glTF: c / max, signed values clamped at -1.
    return std::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<T>::max()),
                    -1.0f);
}

template <typename T>
std::vector<float> floats_of(const AccessorData& data)
{
    std::vector<float> floats(data.count * data.components);
    for (std::size_t i = 0; i < floats.size(); ++i) {
        T value;
        std::memcpy(&value, data.bytes.data() + i * sizeof(T), sizeof(T));
        floats[i] = data.normalized && !std::is_same_v<T, float> ? normalized_float(value)
                                                                 : static_cast<float>(value);
    }
    return floats;
}

}  // namespace

void check_accessors(const GltfDocument& document)
{
    document.root().each("accessors",
                         [&](const JsonView& view, std::size_t) { layout_of(document, view); });
}

AccessorData read_accessor(const GltfDocument& document, std::size_t accessor)
{
    const AccessorLayout layout =
        layout_of(document, document.root().get("accessors").at(accessor));
    AccessorData data = layout.head;
    data.bytes.resize(data.count * data.element_size);

    const auto copy = [&](const Run& run, std::size_t from, std::size_t to) {
        std::memcpy(data.bytes.data() + to * data.element_size, run.first + from * run.stride,
                    data.element_size);
    };
    if (layout.run.first && layout.run.stride == data.element_size)
        std::memcpy(data.bytes.data(), layout.run.first, data.bytes.size());
    else if (layout.run.first)
        for (std::size_t i = 0; i < data.count; ++i)
            copy(layout.run, i, i);

    if (const auto& sparse = layout.sparse)
        for (std::size_t i = 0; i < sparse->count; ++i)
            copy(sparse->values, i,
                 unsigned_at(sparse->indices.first + i * sparse->indices.stride,
                             sparse->index_type));
    return data;
}

Bytes buffer_view_bytes(const GltfDocument& document, const JsonView& index)
{
    const JsonView root = document.root();
    const std::size_t which = index.index(root.count("bufferViews"), "bufferViews");
    const JsonView view = root.get("bufferViews").at(which);
    if (view.find("byteStride"))
        index.fail("must not refer to a bufferView with a byteStride");
    const auto buffer = static_cast<std::size_t>(view.get("buffer").integer(0, INT32_MAX));
    const std::uint8_t* first = document.buffers[buffer].data() + offset_of(view);
    return {first, first + view.get("byteLength").integer(0, kLargestOffset)};
}

std::vector<float> to_floats(const AccessorData& data)
{
    switch (data.component_type) {
    case ComponentType::i8:
        return floats_of<std::int8_t>(data);
    case ComponentType::u8:
        return floats_of<std::uint8_t>(data);
    case ComponentType::i16:
        return floats_of<std::int16_t>(data);
    case ComponentType::u16:
        return floats_of<std::uint16_t>(data);
    case ComponentType::u32:
        return floats_of<std::uint32_t>(data);
    case ComponentType::f32:
        break;
    }
    return floats_of<float>(data);
}

std::vector<std::uint32_t> to_unsigned(const AccessorData& data)
{
    const std::size_t size = component_size(data.component_type);
    std::vector<std::uint32_t> values(data.count * data.components);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = unsigned_at(data.bytes.data() + i * size, data.component_type);
    return values;
}

}  // namespace lumel
