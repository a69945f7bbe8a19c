// Daylight over a year: hours against single bakes of the same hour, and figures that are known.

#include <cmath>
#include <numbers>

#include <glm/trigonometric.hpp>

#include "../support/box_lumels.h"
#include "../support/weather_text.h"
#include "base/core/luminance.h"
#include "links/trace/links.h"
#include "results/daylight/chosen_hours.h"
#include "results/daylight/daylight_maps.h"
#include "results/daylight/daylight_meter.h"
#include "scene/sky/cie_sky.h"
#include "scene/sky/clear_sky.h"
#include "scene/sky/perez_sky.h"
#include "solved.h"

namespace lumel {
namespace {

using support::Quad;
using support::weather_text;
using support::WeatherOfHour;

constexpr double kHalfTurn = std::numbers::pi;
constexpr std::uint32_t kSamples = 1 << 15;

Weather weather_of(const std::string& text)
{
    return read_weather(Bytes(text.begin(), text.end()), "made.epw");
}

/// Meters of a scene.
class Site {
public:
    Site(Scene scene, int size, const Weather& weather, const OccupiedHours& occupied = {})
        : scene_(std::move(scene), {.size = size}),
          dark_(scene_.lumels.lumels.size(), glm::vec3(0.0f)),
          year_(weather, occupied),
          reflected_(scene_, year_.sun_places(), {}),
          meter_(scene_.scene, scene_.rays, scene_.atlas, scene_.lumels, dark_,
                 {.samples = kSamples}),
          daylight_(meter_, year_, reflected_, 1)
    {
    }

    const SolveScene& scene() const { return scene_; }
    const DaylightYear& year() const { return year_; }
    const DaylightMeter& daylight() const { return daylight_; }
    MeterPoint point(const glm::dvec3& place) const
    {
        return {.position = glm::vec3(place - scene_.scene.origin)};
    }
    DaylightReading read(const glm::dvec3& place, double target = 300.0) const
    {
        return daylight_.read(point(place), 0, target);
    }

private:
    SolveScene scene_;
    std::vector<glm::vec3> dark_;
    DaylightYear year_;
    ReflectedDaylight reflected_;
    LightMeter meter_;
    DaylightMeter daylight_;
};

/// Black, far below.
const Quad kGround{.corner = {0.0f, -1.0f, 0.0f},
                   .edge_u = {0.1f, 0.0f, 0.0f},
                   .edge_v = {0.0f, 0.0f, -0.1f},
                   .albedo = glm::vec3(0.0f)};

Scene open_place()
{
    return support::make_quads({kGround}).scene;
}

/// Clear and grey days in turn.
WeatherOfHour mixed(int hour)
{
    const int of_day = hour % 24;
    if (of_day < 6 || of_day > 18)
        return {};
    const double up = std::sin(kHalfTurn * (of_day - 6) / 12.0);
    return hour / 24 % 2 == 0 ? WeatherOfHour{.direct = 700.0 * up, .diffuse = 30.0 + 70.0 * up}
                              : WeatherOfHour{.diffuse = 20.0 + 130.0 * up};
}

/// The same days with illuminance.
WeatherOfHour mixed_with_lux(int hour)
{
    WeatherOfHour is = mixed(hour);
    is.direct_lux = 100.0 * is.direct;
    is.diffuse_lux = 120.0 * is.diffuse;
    return is;
}

/// The sky of an hour as an image, by each texel's own direction.
Sky image_of_hour(const Weather& weather, const WeatherHour& hour)
{
    const SunPosition sun = sun_position(weather.latitude, weather.longitude, hour.middle);
    const PerezSky perez({hour.direct, hour.diffuse, hour.day_of_year, hour.dew_point}, sun);
    Sky sky{.width = 512, .height = 256};
    sky.radiance.assign(std::size_t(sky.width) * std::size_t(sky.height), glm::vec3(0.0f));
    const glm::dvec3 to_sun(direction_of(sun));
    for (int row = 0; row < sky.height / 2; ++row)
        for (int column = 0; column < sky.width; ++column) {
            const double zenith = kHalfTurn * (row + 0.5) / sky.height;
            const double phi = 2.0 * kHalfTurn * (column + 0.5) / sky.width;
            const glm::dvec3 to(-std::cos(phi) * std::sin(zenith), std::cos(zenith),
                                -std::sin(phi) * std::sin(zenith));
            sky.radiance[std::size_t(row * sky.width + column)] = glm::vec3(float(
                perez.luminance(to.y, std::acos(std::clamp(glm::dot(to, to_sun), -1.0, 1.0)))));
        }
    const double level =
        hour.diffuse * perez.diffuse_efficacy() / luminance(glm::vec3(sky_irradiance(sky)));
    for (glm::vec3& radiance : sky.radiance)
        radiance *= float(level);
    return sky;
}

/// The office by day, its panels off.
Scene unlit_office()
{
    Scene office = read_scene(support::scene_path("office"), MaterialModel::diffuse, {});
    office.lights.clear();
    for (Material& material : office.materials)
        material.emitted = glm::vec3(0.0f);
    return office;
}

/// The office under sky and sun of an hour. lux: of the sun.
SolveScene office_in(const Weather& weather, std::size_t hour, float lux, int size)
{
    Scene scene = unlit_office();
    scene.sky = image_of_hour(weather, weather.hours[hour]);
    if (lux > 0.0f) {
        scene.lights.push_back(sun_light(
            sun_position(weather.latitude, weather.longitude, weather.hours[hour].middle)));
        scene.lights.back().intensity = lux;
    }
    return SolveScene(std::move(scene), {.size = size});
}

std::vector<glm::vec3> baked(const SolveScene& world, double error)
{
    SolverOptions options;
    options.method = LinksOptions{};
    options.target_error = error;
    options.target_quality = {};
    LinkRadiosity solver(world, LinksOptions{}, options.limits());
    EXPECT_TRUE(solve(solver, options));
    return solver.irradiance();
}

/// Of the year, by its number in the file.
std::size_t hour_numbered(const DaylightYear& year, std::size_t number)
{
    std::size_t h = 0;
    while (year.number(h) != number)
        ++h;
    return h;
}

/// Light of the maps in an hour [N].
Estimates sum_of_maps(const DaylightMaps& maps, std::size_t hour)
{
    Estimates sum(maps.light.front().size(), glm::vec3(0.0f));
    for (std::size_t k = 0; k < maps.hours.size(); ++k)
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += maps.weights[hour * maps.hours.size() + k] * maps.light[k][i];
    return sum;
}

}  // namespace

TEST(Daylight, OfAnOpenPointIsAllOfThatOutdoors)
{
    const Weather weather = weather_of(weather_text(mixed));
    const Site open(open_place(), 16, weather);
    const DaylightReading reading = open.read({0.0, 0.0, 0.0});
    EXPECT_NEAR(reading.factor, 1.0, 0.005);
    EXPECT_LT(reading.factor_noise, 0.005);
    const DaylightCoefficients found = open.daylight().coefficients(open.point({}), 0);
    for (std::size_t h = 0; h < open.year().hours(); h += 97) {
        const WeatherHour& hour = weather.hours[open.year().number(h)];
        const SunPosition sun = sun_position(weather.latitude, weather.longitude, hour.middle);
        if (!(hour.diffuse > 0.0))
            continue;
        const PerezSky sky({hour.direct, hour.diffuse, hour.day_of_year, hour.dew_point}, sun);
        double expected = hour.diffuse * sky.diffuse_efficacy();
        if (sun.elevation > 0.0)
            expected += hour.direct * sky.direct_efficacy() * std::sin(sun.elevation);
        const HourReading read = open.daylight().hour(open.point({}), 0, found, h);
        // A ray goes to any point of the sun's disc: its radius is 0.0047.
        EXPECT_NEAR(read.lux, expected, 0.01 * expected + 0.005 * double(open.year().sun(h).lux))
            << h;
    }
}

/// An hour without light of the sky keeps its sun.
TEST(Daylight, OfTheSunAloneIsItsCosine)
{
    for (const double lux : {0.0, 60000.0}) {
        const Weather weather = weather_of(weather_text([&](int hour) {
            const bool is_noon = hour % 24 == 12;
            return is_noon ? WeatherOfHour{.direct = 600.0, .direct_lux = lux} : WeatherOfHour{};
        }));
        const Site open(open_place(), 16, weather, {12, 13});
        const std::size_t june = 171;
        const double up = double(open.year().sun(june).direction.y);
        EXPECT_GT(up, 0.8);
        const DaylightCoefficients found = open.daylight().coefficients(open.point({}), 0);
        // The efficacy of the sun in a clear sky is 100 lm/W within a tenth.
        EXPECT_NEAR(open.daylight().hour(open.point({}), 0, found, june).lux, 60000.0 * up,
                    (lux > 0.0 ? 0.01 : 0.1) * 60000.0 * up);
    }
}

/// Under a screen with a hole, a black room has the overcast sky's light through the hole alone.
TEST(Daylight, ThroughAHoleIsItsSkyComponent)
{
    constexpr float kHalf = 0.5f, kFar = 20.0f;  // of the hole, of the screen [m], 1 m above
    const auto part = [&](float x1, float x2, float z1, float z2) {
        return Quad{.corner = {x1, 1.0f, z1},
                    .edge_u = {x2 - x1, 0.0f, 0.0f},
                    .edge_v = {0.0f, 0.0f, z2 - z1},
                    .albedo = glm::vec3(0.0f)};
    };
    const Site site(support::make_quads({part(-kFar, -kHalf, -kFar, kFar),
                                         part(kHalf, kFar, -kFar, kFar),
                                         part(-kHalf, kHalf, -kFar, -kHalf),
                                         part(-kHalf, kHalf, kHalf, kFar),
                                         {.corner = {-kFar, -0.1f, kFar},
                                          .edge_u = {2.0f * kFar, 0.0f, 0.0f},
                                          .edge_v = {0.0f, 0.0f, -2.0f * kFar},
                                          .albedo = glm::vec3(0.0f)}})
                        .scene,
                    32, weather_of(weather_text(mixed)));
    for (const double x : {0.0, 0.9}) {
        // Σ L cos²Z dA / r², with cos Z = 1 / r, and L = 9 / (7π) (1 + 2 cos Z) / 3 for 1 lx.
        constexpr int kParts = 400;
        double expected = 0.0;
        for (int i = 0; i < kParts; ++i)
            for (int j = 0; j < kParts; ++j) {
                const double u = (i + 0.5) / kParts - 0.5 - x, v = (j + 0.5) / kParts - 0.5;
                const double squared = u * u + v * v + 1.0, cosine = 1.0 / std::sqrt(squared);
                expected += 9.0 / (7.0 * kHalfTurn) * (1.0 + 2.0 * cosine) / 3.0 * cosine * cosine /
                            squared / (double(kParts) * kParts);
            }
        const DaylightReading reading = site.read({x, 0.0, 0.0});
        EXPECT_NEAR(reading.factor, expected, 4.0 * reading.factor_noise + 0.01 * expected) << x;
        EXPECT_LT(reading.factor_noise, 0.01 * expected);
    }
}

TEST(Daylight, AutonomyIsTheShareOfHoursWithEnoughLight)
{
    // 1,000 lx on three days of ten, 200 on two, 50 on one, none on the others.
    constexpr double kLux[] = {1000.0, 1000.0, 1000.0, 200.0, 200.0, 50.0, 0.0, 0.0, 0.0, 0.0};
    std::array<double, 4> days{};
    for (int day = 0; day < 365; ++day)
        days[kLux[day % 10] > 300.0 ? 2 : kLux[day % 10] > 100.0 ? 1 : 0] += 1.0 / 365.0;
    const Weather weather = weather_of(weather_text([&](int hour) {
        const double lux = kLux[hour / 24 % 10];
        return WeatherOfHour{.diffuse = 0.01 * lux, .diffuse_lux = lux};
    }));
    const Site open(open_place(), 16, weather);
    ASSERT_EQ(open.year().hours(), 3650u);
    const DaylightReading reading = open.read({0.0, 0.0, 0.0});
    EXPECT_NEAR(reading.autonomy, days[2], 1e-9);
    for (std::size_t k = 0; k < days.size(); ++k)
        EXPECT_NEAR(reading.useful[k], days[k], 1e-9) << k;
    EXPECT_NEAR(reading.mean_lux, 1000.0 * days[2] + 200.0 * days[1] + 50.0 * (36.0 / 365.0), 3.0);
    EXPECT_NEAR(open.read({0.0, 0.0, 0.0}, 150.0).autonomy, days[1] + days[2], 1e-9);
    // A point counts from half of the hours on, unless it is in an object or outdoors.
    const std::array<DaylightReading, 4> points = {
        DaylightReading{.factor = 0.02, .autonomy = 0.5},
        DaylightReading{.factor = 0.04, .autonomy = 0.49},
        DaylightReading{.factor = 1.0, .autonomy = 1.0, .inside = true},
        DaylightReading{.factor = 1.0, .autonomy = 1.0, .open = 0.6}};
    const DaylightFigures figures = figures_of(points);
    EXPECT_EQ(figures.sufficient, 0.5);
    EXPECT_NEAR(figures.factor, 0.03, 1e-12);
    EXPECT_EQ(figures.count, 2u);
    EXPECT_EQ(figures.outdoors, 1u);
    EXPECT_TRUE(reading.is_outdoors());
}

/// Light that a lumel has is reflected without end: with D everywhere, X = ρ D / (1 − ρ).
TEST(Daylight, FromOutsideIsReflectedAsInAFurnace)
{
    const SolveScene furnace(support::scene_path("furnace-0.9"), {.size = 32});
    const std::size_t count = furnace.lumels.lumels.size();
    LinkRadiosity links(furnace,
                        LinksOptions{.filter = false, .even_rays = 96, .outside_light = true}, {});
    while (!links.state().ended)
        links.step();
    std::vector<glm::vec3> direct;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t lane = 0; lane < kLampLanes; ++lane)
            direct.emplace_back(float(lane));
    const std::vector<glm::vec3> found = links.reflected(direct);
    double open = 0.0;
    std::array<double, kLampLanes> mean{};
    for (std::size_t i = 0; i < count; ++i) {
        if (furnace.lumels.lumels[i].flags & kLumelBuried)
            continue;
        open += 1.0;
        for (std::size_t lane = 0; lane < kLampLanes; ++lane)
            mean[lane] += double(found[i * kLampLanes + lane].g);
    }
    ASSERT_GT(open, 100.0);
    for (std::size_t lane = 0; lane < kLampLanes; ++lane)
        EXPECT_NEAR(mean[lane] / open, 9.0 * double(lane), 0.02 * 9.0 * double(lane)) << lane;
}

/// Glass over an open point dims the sky and the sun by its tint.
TEST(Daylight, BehindGlassHasItsTint)
{
    constexpr float kWide = 500.0f, kTint = 0.4f;
    Scene scene = support::make_quads({{.corner = {-kWide, 1.0f, -kWide},
                                        .edge_u = {2.0f * kWide, 0.0f, 0.0f},
                                        .edge_v = {0.0f, 0.0f, 2.0f * kWide},
                                        .albedo = glm::vec3(kTint)},
                                       kGround})
                      .scene;
    scene.materials[0].transmission = 1.0f;
    scene.materials[0].double_sided = true;
    const Weather weather = weather_of(weather_text(mixed));
    const Site glazed(std::move(scene), 16, weather), open(open_place(), 16, weather);
    const DaylightReading behind = glazed.read({0.0, 0.0, 0.0}), bare = open.read({0.0, 0.0, 0.0});
    EXPECT_NEAR(behind.factor, double(kTint), 0.01 * double(kTint));
    EXPECT_NEAR(behind.mean_lux, double(kTint) * bare.mean_lux, 0.01 * behind.mean_lux);
    EXPECT_TRUE(bare.is_outdoors());
    EXPECT_FALSE(behind.is_outdoors());
}

TEST(Daylight, OfAYearIsTheMeanOfItsHours)
{
    const Weather weather = weather_of(weather_text(mixed));
    const Site office(unlit_office(), 64, weather, {14, 17});
    const MeterPoint point = office.point({1.0, 0.85, 2.5});
    const DaylightCoefficients found = office.daylight().coefficients(point, 0);
    double sum = 0.0, sun = 0.0;
    for (std::size_t h = 0; h < office.year().hours(); ++h) {
        sum += office.daylight().hour(point, 0, found, h).lux;
        sun += double(office.year().sun(h).lux);
    }
    EXPECT_GT(sun, 0.0);
    const double mean = sum / double(office.year().hours());
    EXPECT_NEAR(office.daylight().read(point, 0, 300.0).mean_lux, mean, 1e-4 * mean);
}

TEST(Daylight, HoursOfTheDayAreLocal)
{
    const Weather weather = weather_of(weather_text([](int hour) {
        return hour % 24 == 8 ? WeatherOfHour{.diffuse = 10.0, .diffuse_lux = 1000.0}
                              : WeatherOfHour{};  // from 8 to 9
    }));
    EXPECT_NEAR(Site(open_place(), 16, weather, {8, 10}).read({}).autonomy, 0.5, 1e-9);
    EXPECT_NEAR(Site(open_place(), 16, weather, {9, 10}).read({}).autonomy, 0.0, 1e-9);
}

/// Of the sun's light only that reflected is interpolated, and the sky is in patches: both within
/// what single bakes state and the rays of the meters.
TEST(Daylight, OfAnHourIsThatOfABakeOfTheSameHour)
{
    constexpr int kSize = 96;
    constexpr double kBake = 0.02;
    const Weather weather = weather_of(weather_text(mixed));
    const Site site(unlit_office(), kSize, weather);
    const glm::dvec3 places[] = {{1.0, 0.85, 2.5}, {3.0, 0.85, 1.9}, {6.0, 0.85, 3.0}};
    std::vector<DaylightCoefficients> found;
    for (const glm::dvec3& place : places)
        found.push_back(site.daylight().coefficients(site.point(place), 0));
    // A clear afternoon in May, when the sun shines in, a grey noon, and a clear winter's day.
    for (const std::size_t wanted : {24u * 136 + 16, 24u * 101 + 12, 24u * 350 + 13}) {
        const std::size_t h = hour_numbered(site.year(), wanted);
        const SolveScene world = office_in(weather, wanted, site.year().sun(h).lux, kSize);
        const std::vector<glm::vec3> light = baked(world, kBake);
        const LightMeter meter(world.scene, world.rays, world.atlas, world.lumels, light,
                               {.samples = kSamples});
        for (std::size_t p = 0; p < std::size(places); ++p) {
            const HourReading hour = site.daylight().hour(site.point(places[p]), 0, found[p], h);
            const Reading single = meter.read(site.point(places[p]), 0);
            const double error = std::hypot(hour.noise, hour.interpolation);
            const double stated = std::hypot(error, single.noise, kBake * single.lux);
            EXPECT_NEAR(hour.lux, single.lux, 3.0 * stated) << wanted << ", place " << p;
            EXPECT_NEAR(hour.lux, single.lux, 0.04 * single.lux) << wanted << ", place " << p;
            EXPECT_LT(error, 0.1 * hour.lux) << wanted << ", place " << p;
        }
    }
}

/// Strengths of n sources in hours that are sums of a few patterns.
std::vector<float> of_patterns(std::size_t hours, std::size_t n, std::size_t patterns)
{
    std::vector<float> strengths;
    for (std::size_t h = 0; h < hours; ++h)
        for (std::size_t k = 0; k < n; ++k) {
            double sum = 0.0;
            for (std::size_t p = 0; p < patterns; ++p)
                sum += (1.0 + std::sin(double(h * (p + 1)) * 0.37)) *
                       (1.0 + std::cos(double(k * (p + 2)) * 0.91));
            strengths.push_back(float(sum));
        }
    return strengths;
}

/// As many hours as there are patterns in the year give all of its hours.
TEST(DaylightMaps, AreAsManyAsThePatternsOfTheYear)
{
    constexpr std::size_t kSources = 12, kHours = 200, kPatterns = 4, kPlaces = 50;
    const std::vector<float> strengths = of_patterns(kHours, kSources, kPatterns);
    std::vector<float> coefficients;
    for (std::size_t i = 0; i < kPlaces * kSources; ++i)
        coefficients.push_back(float(1.0 + std::sin(double(i * i) * 0.13)));
    const std::vector<float> root = light_root(coefficients, kSources);
    const ChosenHours chosen = choose_hours(root, strengths, kSources, 1e-3, 20);
    EXPECT_EQ(chosen.hours.size(), kPatterns);
    const auto light = [&](std::size_t hour, std::size_t place) {
        double sum = 0.0;
        for (std::size_t k = 0; k < kSources; ++k)
            sum +=
                double(coefficients[place * kSources + k]) * double(strengths[hour * kSources + k]);
        return sum;
    };
    for (std::size_t h = 0; h < kHours; ++h)
        for (std::size_t place = 0; place < kPlaces; ++place) {
            double sum = 0.0;
            for (std::size_t k = 0; k < chosen.hours.size(); ++k)
                sum += double(chosen.weights[h * chosen.hours.size() + k]) *
                       light(chosen.hours[k], place);
            EXPECT_NEAR(sum, light(h, place), 0.005 * light(h, place)) << h << ", " << place;
        }
    // Fewer leave the error that is stated.
    const ChosenHours fewer = choose_hours(root, strengths, kSources, 1e-3, 2);
    ASSERT_EQ(fewer.hours.size(), 2u);
    double squares = 0.0;
    for (std::size_t h = 0; h < kHours; ++h) {
        double wrong = 0.0, all = 0.0;
        for (std::size_t place = 0; place < kPlaces; ++place) {
            const double is = light(h, place);
            double sum = 0.0;
            for (std::size_t k = 0; k < 2; ++k)
                sum += double(fewer.weights[2 * h + k]) * light(fewer.hours[k], place);
            wrong += (sum - is) * (sum - is);
            all += is * is;
        }
        squares += wrong / all / double(kHours);
    }
    EXPECT_NEAR(fewer.error, std::sqrt(squares), 0.01 * fewer.error);
    EXPECT_GT(fewer.error, 0.01);
}

/// Open black ground has the light of the sky, and no more.
TEST(DaylightMaps, OfOpenGroundAreTheSky)
{
    const Weather weather = weather_of(weather_text(mixed_with_lux));
    const DaylightYear year(weather, {0, 24});
    const SolveScene open(open_place(), {.size = 16});
    const DaylightMaps maps = daylight_maps(open, {.size = 16}, year, 1);
    EXPECT_LE(maps.error, kMapsError);
    for (std::size_t h = 0; h < year.hours(); h += 97) {
        const double lux = weather.hours[year.number(h)].diffuse_lux;
        // A patch has one luminance for its whole width of 12°.
        EXPECT_NEAR(maps.mean[h], lux, 0.02 * lux) << h;
        const Estimates sum = sum_of_maps(maps, h);
        for (std::size_t i = 0; i < sum.size(); ++i)
            EXPECT_NEAR(luminance(sum[i]), lux, 0.04 * lux) << h << ", " << i;
    }
}

/// A sheet high above wide ground: the sky above it, and below, what the ground reflects of sky and
/// sun.
TEST(DaylightMaps, LightEachSideOfASheetByItself)
{
    constexpr float kWide = 200.0f, kHigh = 5.0f;
    constexpr double kAlbedo = 0.5;
    const Weather weather = weather_of(weather_text(mixed_with_lux));
    const DaylightYear year(weather, {0, 24});
    const AtlasOptions options{.size = 64, .daylit = true};
    const SolveScene place(support::make_quads({{.corner = {-kWide / 2.0f, 0.0f, kWide / 2.0f},
                                                 .edge_u = {kWide, 0.0f, 0.0f},
                                                 .edge_v = {0.0f, 0.0f, -kWide},
                                                 .albedo = glm::vec3(float(kAlbedo))},
                                                {.corner = {-0.5f, kHigh, 0.5f},
                                                 .edge_v = {0.0f, 0.0f, -1.0f},
                                                 .albedo = glm::vec3(0.0f),
                                                 .double_sided = true}})
                               .scene,
                           options);
    const DaylightMaps maps = daylight_maps(place, options, year, 1);
    const WorldLumels world(place.scene, place.rays, place.lumels);
    for (std::size_t h = 0; h < year.hours(); h += 97) {
        const double sky = weather.hours[year.number(h)].diffuse_lux;
        if (!(sky > 0.0))
            continue;
        const double sun = double(year.sun(h).lux) * double(year.sun(h).direction.y);
        const Estimates sum = sum_of_maps(maps, h);
        glm::dvec2 light(0.0), area(0.0);  // above, below
        for (std::size_t i = 0; i < sum.size(); ++i)
            if (const Lumel& lumel = place.lumels.lumels[i]; lumel.instance == 1) {
                const int side = world[i].normal.y > 0.0f ? 0 : 1;
                light[side] += double(lumel.area) * luminance(sum[i]);
                area[side] += double(lumel.area);
            }
        EXPECT_NEAR(area[0], 1.0, 1e-3);
        EXPECT_NEAR(area[1], 1.0, 1e-3);
        EXPECT_NEAR(light[0], sky, 0.02 * sky) << h;
        const double below = kAlbedo * (sky + std::max(sun, 0.0));
        EXPECT_LT(maps.errors[h], 0.1) << h;
        EXPECT_NEAR(light[1], below, (0.03 + maps.errors[h]) * below) << h;
    }
}

/// Surfaces that face away from the sun have only light that is in the maps.
TEST(DaylightMaps, OfAnHourAreThatOfABakeOfTheSameHour)
{
    constexpr int kSize = 96;
    constexpr double kBake = 0.02;
    const Weather weather = weather_of(weather_text(mixed));
    const DaylightYear year(weather, {0, 24});
    const SolveScene office(unlit_office(), {.size = kSize});
    const DaylightMaps maps = daylight_maps(office, {.size = kSize}, year, 1);
    EXPECT_LE(maps.error, kMapsError);
    EXPECT_LE(maps.hours.size(), kMostDaylightMaps);
    const WorldLumels lumels(office.scene, office.rays, office.lumels);
    for (const std::size_t wanted : {24u * 136 + 16, 24u * 101 + 12, 24u * 350 + 13}) {
        const std::size_t h = hour_numbered(year, wanted);
        const Estimates sum = sum_of_maps(maps, h);
        const std::vector<glm::vec3> whole =
            baked(office_in(weather, wanted, year.sun(h).lux, kSize), kBake);
        ASSERT_EQ(whole.size(), sum.size());
        double wrong = 0.0, compared = 0.0, of_maps = 0.0, of_bake = 0.0, squares = 0.0,
               whole_weight = 0.0;
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const Lumel& lumel = office.lumels.lumels[i];
            const bool may_see_sun = glm::dot(lumels[i].normal, year.sun(h).direction) > -0.01f;
            const double own = double(lumel.area), mapped = luminance(sum[i]);
            const auto weight = double(maps.lumel_weights[i]);
            if (lumel.flags & kLumelBuried)
                continue;
            squares += weight * mapped * mapped;
            whole_weight += weight;
            if (year.sun(h).lux > 0.0f && may_see_sun)
                continue;
            const double is = luminance(whole[i]);
            wrong += weight * (mapped - is) * (mapped - is);
            compared += weight;
            of_maps += own * mapped;
            of_bake += own * is;
        }
        ASSERT_GT(of_bake, 0.0);
        EXPECT_NEAR(of_maps, of_bake, 0.02 * of_bake) << wanted;
        const double stated = std::hypot(maps.errors[h], kBake);
        const double found = std::sqrt(wrong / compared / squares * whole_weight);
        EXPECT_LT(found, 1.2 * stated) << wanted << " stated " << maps.errors[h];
        RecordProperty("hour " + std::to_string(wanted),
                       std::to_string(found) + " of " + std::to_string(stated));
        EXPECT_LT(stated, 0.15) << wanted;
    }
}

}  // namespace lumel
