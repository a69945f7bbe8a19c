// EXR files by OpenEXR: one part, scan lines, ZIP, linear values.

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <OpenEXRConfig.h>
#include <half.h>

#include "base/core/error.h"
#include "base/core/files.h"
#include "base/images/exr_claims.h"
#include "base/images/image_files.h"

namespace lumel {
namespace {

constexpr std::array<const char*, 4> kChannels = {"R", "G", "B", "A"};
// Collects the file in memory; write_bytes() then writes it and reports failures.
class MemoryStream : public Imf::OStream {
public:
    MemoryStream() : Imf::OStream("memory") {}
    void write(const char data[], int count) override
    {
        bytes.resize(std::max(bytes.size(), place_ + std::size_t(count)));
        std::memcpy(bytes.data() + place_, data, std::size_t(count));
        place_ += std::size_t(count);
    }
    std::uint64_t tellp() override { return place_; }
    void seekp(std::uint64_t place) override { place_ = place; }

    std::vector<std::byte> bytes;

private:
    std::size_t place_ = 0;
};

// A file in memory, for OpenEXR to read.
class MemoryFile : public Imf::IStream {
public:
    MemoryFile(const std::string& path, const Bytes& bytes)
        : Imf::IStream(path.c_str()),
          bytes_(bytes)
    {
    }
    bool read(char into[], int count) override
    {
        if (count < 0 || std::size_t(count) > bytes_.size() - std::min(place_, bytes_.size()))
            throw std::runtime_error("the file is cut short");
        std::memcpy(into, bytes_.data() + place_, std::size_t(count));
        place_ += std::size_t(count);
        return place_ < bytes_.size();
    }
    std::uint64_t tellg() override { return place_; }
    void seekg(std::uint64_t place) override { place_ = place; }

private:
    const Bytes& bytes_;
    std::size_t place_ = 0;
};

// A slice for channel c of interleaved texels; the data window starts at (x, y).
template <class T>
Imf::Slice slice_of(Imf::PixelType type, T* values, int channels, int width, int c, int x, int y,
                    double fill = 0.0)
{
    const std::ptrdiff_t texel = std::ptrdiff_t(sizeof(T)) * channels;
    const std::ptrdiff_t row = texel * width;
    char* base = reinterpret_cast<char*>(values + c) - x * texel - y * row;
    return Imf::Slice(type, base, std::size_t(texel), std::size_t(row), 1, 1, fill);
}

std::string channel_name(const std::string& layer, int c)
{
    return layer.empty() ? kChannels[c] : layer + "." + kChannels[c];
}

std::vector<half> to_half(const std::vector<float>& values)
{
    // Clamps to half's range: infinity would spoil filtering.
    std::vector<half> halves(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        halves[i] = half(std::clamp(values[i], -float(HALF_MAX), float(HALF_MAX)));
    return halves;
}

// Converted values of a file's images, and the slices that refer to them.
class Planes {
public:
    Planes(Imf::Header& header, Precision precision) : header_(header), precision_(precision) {}

    // `image` must outlive this and not move.
    void add(const std::string& layer, const Image& image, int channels)
    {
        if (precision_ == Precision::float16) {
            halves_.push_back(to_half(image.values));
            insert(layer, image, channels, Imf::HALF, halves_.back().data());
        } else {
            insert(layer, image, channels, Imf::FLOAT, const_cast<float*>(image.values.data()));
        }
    }

    void write(MemoryStream& stream) const
    {
        const int threads = int(std::thread::hardware_concurrency());
        Imf::setGlobalThreadCount(threads);  // does not affect the bytes
        Imf::OutputFile file(stream, header_, threads);
        file.setFrameBuffer(frame_);
        file.writePixels(header_.dataWindow().max.y + 1);
    }

private:
    template <class T>
    void insert(const std::string& layer, const Image& image, int channels, Imf::PixelType type,
                T* values)
    {
        for (int c = 0; c < channels; ++c) {
            const std::string name = channel_name(layer, c);
            header_.channels().insert(name, Imf::Channel(type));
            frame_.insert(name, slice_of(type, values, image.channels, image.width, c, 0, 0));
        }
    }

    Imf::Header& header_;
    Precision precision_;
    Imf::FrameBuffer frame_;
    std::vector<std::vector<half>> halves_;
};

[[noreturn]] void fail_without(const std::string& path, const std::string& channel)
{
    throw Error(ErrorKind::input, path,
                "has no channel " + channel + "; an RGB or RGBA image is needed");
}

}  // namespace

void write_exr(const std::string& path, const Image& image, Precision precision,
               const std::map<std::string, std::string>& metadata, std::span<const Layer> layers)
{
    MemoryStream stream;
    try {
        Imf::Header header(image.width, image.height);
        header.compression() = Imf::ZIP_COMPRESSION;
        for (const auto& [name, value] : metadata)
            header.insert(name, Imf::StringAttribute(value));
        Planes planes(header, precision);
        planes.add("", image, image.channels);
        for (const Layer& layer : layers) {
            assert(layer.image.width == image.width && layer.image.height == image.height);
            planes.add(layer.name, layer.image, 3);
        }
        planes.write(stream);
    } catch (const std::exception& error) {
        throw Error(ErrorKind::output, path,
                    std::string("cannot be encoded as EXR: ") + error.what());
    }
    write_bytes(path, stream.bytes);
}

std::optional<Image> find_exr_layer(const std::string& path, const std::string& layer)
{
    try {
        const Bytes bytes = read_file(path, path);
        check_exr_claims(bytes, path);
        MemoryFile stream(path, bytes);
        Imf::InputFile file(stream);
        const Imath::Box2i window = file.header().dataWindow();
        const Imf::ChannelList& channels = file.header().channels();
        if (!channels.findChannel(channel_name(layer, 0)))
            return std::nullopt;
        for (int c = 1; c < 3; ++c)
            if (!channels.findChannel(channel_name(layer, c)))
                fail_without(path, channel_name(layer, c));

        Image image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1, 4);
        Imf::FrameBuffer frame;
        for (int c = 0; c < 4; ++c)
            frame.insert(channel_name(layer, c),
                         slice_of(Imf::FLOAT, image.values.data(), 4, image.width, c, window.min.x,
                                  window.min.y, c == 3 ? 1.0 : 0.0));
        file.setFrameBuffer(frame);
        file.readPixels(window.min.y, window.max.y);
        return image;
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        throw Error(ErrorKind::input, path, std::string("cannot be read as EXR: ") + error.what());
    }
}

Image read_exr(const std::string& path, const std::string& layer)
{
    std::optional<Image> image = find_exr_layer(path, layer);
    if (!image)
        fail_without(path, channel_name(layer, 0));
    return std::move(*image);
}

std::string openexr_version()
{
    return OPENEXR_VERSION_STRING;
}

}  // namespace lumel
