// Images of a session: lit, in false colours, and the lumels.

#include <algorithm>
#include <cmath>

#include "atlas/finish/finish.h"
#include "atlas/lumels/sides.h"
#include "base/core/clock.h"
#include "base/core/error.h"
#include "base/core/luminance.h"
#include "base/images/image_files.h"
#include "viewer/session/session.h"

namespace lumel {
namespace {

/// Brightness of dark fields of a chart's checkerboard.
constexpr float kDarkField = 0.7f;
constexpr float kPercent = 100.0f;
constexpr float kGoldenTurn = 0.618034f;  ///< step in the circle of hues between charts

/// A distinct colour for each number, of equal brightness.
glm::vec3 colour_of(std::uint32_t number)
{
    const float hue = 6.0f * std::fmod(kGoldenTurn * float(number), 1.0f);
    const glm::vec3 pure =
        glm::clamp(glm::vec3(std::abs(hue - 3.0f) - 1.0f, 2.0f - std::abs(hue - 2.0f),
                             2.0f - std::abs(hue - 4.0f)),
                   0.0f, 1.0f);
    return glm::mix(glm::vec3(0.5f), pure, 0.6f);
}

/// Map of an atlas: charts in their colours, lumels as a checkerboard.
Image board(const Lumels& lumels)
{
    Image map(lumels.width, lumels.height, 4);
    for (const Lumel& lumel : lumels.lumels) {
        const auto texel = int(map_texel(lumels, lumel));
        const int x = texel % lumels.width, y = texel / lumels.width;
        const float field = (x + y) % 2 == 0 ? 1.0f : kDarkField;
        const glm::vec3 colour = field * colour_of(map_chart(lumels, lumel));
        float* const out = map.at(x, y);
        for (int c = 0; c < 3; ++c)
            out[c] = colour[c];
        out[3] = 1.0f;
    }
    return map;
}

/// One channel per pixel, < 0 without a surface.
Image luminances(const Image& image)
{
    Image one(image.width, image.height, 1);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const float* const pixel = image.at(x, y);
            *one.at(x, y) =
                pixel[3] > 0.0f ? float(luminance({pixel[0], pixel[1], pixel[2]})) : -1.0f;
        }
    return one;
}

}  // namespace

void FrameCosts::add(double ms)
{
    ++frames;
    last_ms = ms;
    most_ms = std::max(most_ms, ms);
    all_ms += ms;
}

/// Discards solved and baked light, as the scene has changed. Balls remain until it is at rest.
void ViewSession::note_edit()
{
    ++edits_;
    if (bake_)
        bake_->stop();
    by_links_ = {.has_balls = by_links_.has_balls};
    solved_.reset();
    by_solver_ = {};
}

bool ViewSession::take_solved(SolvedLight light, std::uint64_t edits)
{
    if (edits != edits_)
        return false;
    by_solver_ = {.irradiance = std::move(light.irradiance)};
    solved_ = std::move(light);
    shows_solved_ = true;
    return true;
}

void ViewSession::show_solved(bool solved)
{
    if (solved && !solved_)
        throw Error(ErrorKind::input, "", "the current scene has no solved light");
    shows_solved_ = solved;
}

bool ViewSession::shows_solved() const
{
    return solved_ && shows_solved_ && mode_ != ViewMode::links;
}

const std::vector<glm::vec3>& ViewSession::irradiance_of(Seen& seen)
{
    if (seen.irradiance.empty())
        seen.irradiance = live_.shown();
    return seen.irradiance;
}

/// Moved objects can bury lumels, or uncover them.
Lumels ViewSession::shown_lumels() const
{
    return shows_solved() ? with_buried(live_.lumels(), solved_->buried) : live_.shown_lumels();
}

const Image& ViewSession::map()
{
    std::optional<Image>& map = seen().map;
    if (!map)
        map = finish_map(shown_, live_.atlas(), shown_lumels(), irradiance());
    return *map;
}

glm::ivec2 ViewSession::size() const
{
    return preview_size(*device_, camera_.view(), options_.width);
}

const Image& ViewSession::render(const Image& map, PreviewShows shows)
{
    if (!preview_)
        preview_.emplace(*device_, shown_, drawn_);
    return preview_->draw(shown_, map, camera_.view(), options_.width, shows);
}

float ViewSession::exposure()
{
    const float of_light =
        exposure_ ? *exposure_ : choose_exposure(render(map(), PreviewShows::light)).value_or(1.0f);
    return of_light * std::exp2(stops_);
}

LuxScale ViewSession::scale()
{
    if (scale_)
        return *scale_;
    std::vector<float> lux;
    for (const glm::vec3& light : irradiance())
        lux.push_back(float(luminance(light)));
    return scale_for(lux);
}

const std::vector<float>& ViewSession::error_estimate()
{
    std::vector<float>& percent = seen().error_estimate;
    if (!percent.empty())
        return percent;
    if (shows_solved())
        percent.assign(live_.lumels().lumels.size(), kPercent * float(solved_->error));
    else
        for (const float part : live_.error_estimate())
            percent.push_back(kPercent * part);
    return percent;
}

/// For surfaces whose sides share texels, uses the displayed side.
Image ViewSession::error_map()
{
    std::vector<glm::vec3> layer;
    for (const float percent : error_estimate())
        layer.emplace_back(percent);
    return finish_maps(shown_, live_.atlas(), shown_lumels(), irradiance(), {&layer, 1})
        .layers.front();
}

LuxScale ViewSession::error_scale()
{
    return error_scale_ ? *error_scale_ : scale_for(error_estimate());
}

void ViewSession::set_scale(const std::optional<LuxScale>& scale)
{
    (mode_ == ViewMode::error ? error_scale_ : scale_) = scale;
}

void ViewSession::set_automatic_exposure(bool automatic)
{
    if (automatic)
        exposure_.reset();
    else
        exposure_ = exposure() / std::exp2(stops_);
}

Image ViewSession::lit_picture()
{
    const Image& light = render(map(), PreviewShows::light);
    const float factor =
        (exposure_ ? *exposure_ : choose_exposure(light).value_or(1.0f)) * std::exp2(stops_);
    if (mode_ != ViewMode::lit || !(probe_spacing_ > 0.0))
        return preview_->tone_mapped(factor);
    Image with_balls = light;
    draw_lit_balls(with_balls);
    return tone_map(with_balls, factor);
}

Image ViewSession::picture(Legend legend)
{
    const Clock::time_point start = Clock::now();
    Image picture = make_picture(legend);
    picture_costs_.add(ms_since(start));
    return picture;
}

/// A map in false colours. unit: for the legend.
Image ViewSession::coloured(const Image& map, const LuxScale& scale, const char* unit,
                            Legend legend)
{
    Image values = luminances(render(map, PreviewShows::map));
    if (mode_ == ViewMode::irradiance && probe_spacing_ > 0.0)
        draw_lux_balls(values);
    return legend == Legend::none ? colours_of(values, scale) : false_colour(values, scale, unit);
}

Image ViewSession::make_picture(Legend legend)
{
    if (mode_ == ViewMode::links)
        return links_picture();
    if (mode_ == ViewMode::irradiance)
        return coloured(map(), scale(), "lx", legend);
    if (mode_ == ViewMode::error)
        return coloured(error_map(), error_scale(), "%", legend);
    if (mode_ == ViewMode::lumels)
        return render(board(live_.lumels()), PreviewShows::texels);
    return lit_picture();
}

double ViewSession::luminance_at(const glm::ivec2& pixel)
{
    check_inside(pixel);
    const Image& light = render(map(), PreviewShows::light);
    const float* const at = light.at(pixel.x, pixel.y);
    return luminance({at[0], at[1], at[2]});
}

std::optional<double> ViewSession::lux_at(const glm::ivec2& pixel)
{
    check_inside(pixel);
    const float lux = *luminances(render(map(), PreviewShows::map)).at(pixel.x, pixel.y);
    return lux < 0.0f ? std::nullopt : std::optional<double>(lux);
}

}  // namespace lumel
