// After any number of edits at random, a live scene is as one that was made so from nothing.

#include <cmath>
#include <fstream>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <unistd.h>

#include "alike.h"
#include "open_box.h"

namespace lumel {
namespace {

using namespace test;

constexpr int kSide = 48;  // of the atlas [texels]
constexpr float kPi = 3.14159265358979f;
/// What an allocator may hold more than before [bytes]: one solution is larger.
constexpr std::uint64_t kSlack = 4u << 20;

const std::string kBlock = "short block", kLight = "light";

std::uint64_t resident_bytes()
{
    std::uint64_t pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    return resident * std::uint64_t(sysconf(_SC_PAGESIZE));
}

/// A live scene, and all that was done to it.
class Edited {
public:
    explicit Edited(std::uint32_t seed)
        : random_(seed),
          live_(lay_out(open_box_in_the_sun(), {.size = kSide}, options_.things), options_)
    {
    }

    void edit()
    {
        switch (std::uniform_int_distribution(0, 7)(random_)) {
        case 0:
            return dim(kLight);
        case 1:
            return dim("lamp");
        case 2:
            return dim("sun");
        case 3:
            sky_ = colour();
            return live_.set_sky(sky_);
        case 4:
            return live_.turn_sky(double(kPi * any()));
        case 5:
            return paint();
        case 6:
            return live_.move_lamp(
                "lamp", glm::translate(glm::mat4(1.0f), glm::vec3(0.25f) + 0.2f * vector()));
        default:
            return move();
        }
    }

    LiveLinks& live() { return live_; }
    /// Made from nothing on the same lumels.
    LiveLinks anew() const { return {copy_of(live_.solve_scene()), options_}; }
    /// Paints and dims another as this one is now.
    void do_to(LiveLinks& fresh) const
    {
        for (const auto& [name, factor] : lamps_)
            fresh.set_lamp(name, factor);
        for (const auto& [name, colour] : paints_)
            fresh.set_albedo(name, colour);
        fresh.set_sky(sky_);
    }

private:
    float any() { return std::uniform_real_distribution<float>(-1.0f, 1.0f)(random_); }
    glm::vec3 vector()
    {
        const float x = any(), y = any(), z = any();
        return {x, y, z};
    }
    glm::vec3 colour() { return 0.5f * (vector() + 1.0f); }

    void dim(const std::string& name)
    {
        lamps_[name] = 2.0f * colour();
        live_.set_lamp(name, lamps_[name]);
    }
    void paint()
    {
        const std::string name = any() < 0.0f ? "red" : "green";
        paints_[name] = 0.8f * colour();
        live_.set_albedo(name, paints_[name]);
    }
    /// Through walls too.
    void move()
    {
        const glm::vec3 centre(0.2f);
        const glm::mat4 to = glm::translate(glm::mat4(1.0f), centre + 0.2f * vector()),
                        motion = glm::translate(
                            glm::rotate(to, kPi * any(), glm::normalize(vector() + 0.01f)),
                            -centre);
        if (any() < 0.0f)
            live_.move(any() < 0.5f ? kBlock : kLight, motion);
        else
            live_.request(any() < 0.5f ? 0 : 1, motion);
    }

    const LiveLinksOptions options_{.rays = 16, .things = {kBlock, kLight}};
    std::mt19937 random_;
    LiveLinks live_;
    std::map<std::string, glm::vec3> lamps_, paints_;
    glm::vec3 sky_{1.0f};
};

/// Edits, some of them while others are still followed; at every rest, what is there is judged.
void expect_all_as_from_nothing(int edits)
{
    constexpr int kBetweenRests = 4;
    Edited scene(11);
    LiveLinks& live = scene.live();
    std::uint64_t bytes = 0, resident = 0;
    int rests = 0;
    for (int k = 1; k <= edits; ++k) {
        scene.edit();
        live.advance(0.0);
        if (k % kBetweenRests != 0)
            continue;
        ASSERT_TRUE(live.settle().at_rest);
        LiveLinks fresh = scene.anew();
        scene.do_to(fresh);
        fresh.settle();
        ASSERT_EQ(different(live, fresh), 0u) << "after " << k << " edits";
        EXPECT_LT(dark_error(live.irradiance(), fresh.irradiance()), 0.02) << k;
        ++rests;
        if (k <= edits / 2) {
            bytes = std::max(bytes, live.bytes());
            resident = std::max(resident, resident_bytes());
        }
    }
    EXPECT_EQ(rests, edits / kBetweenRests);
    EXPECT_LE(live.bytes(), bytes + bytes / 100);  // weights differ with the light
    EXPECT_LE(resident_bytes(), resident + kSlack);
}

TEST(LiveLinksEdits, AHundredAtRandomEndAsASolutionFromNothing)
{
    expect_all_as_from_nothing(100);
}

TEST(LiveLinksEdits, AThousandAtRandomEndAsASolutionFromNothing)
{
    expect_all_as_from_nothing(1000);
}

}  // namespace
}  // namespace lumel
