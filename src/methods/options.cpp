#include "methods/options.h"

namespace lumel {
namespace {

/// Views from lumels, in a bake by a method that has none of its own.
constexpr ViewOptions kOtherViews{.projection = Projection::hemicube, .hemicube = 256, .batch = 16};

}  // namespace

SampleRule rule_of(const MethodOptions& method)
{
    return std::visit(
        [](const auto& options) {
            if constexpr (requires { options.rule; })
                return options.rule;
            else
                return SampleRule::area;
        },
        method);
}

ViewOptions views_of(const MethodOptions& method)
{
    return std::visit(
        [](const auto& options) {
            if constexpr (requires { options.transport; })
                return options.transport.views;
            else if constexpr (requires { options.views; })
                return options.views;
            else
                return kOtherViews;
        },
        method);
}

int batch_of(const MethodOptions& method)
{
    return std::visit(
        [&](const auto& options) {
            if constexpr (std::is_same_v<std::decay_t<decltype(options)>, LinksOptions>)
                return 0;
            else if constexpr (requires { options.batch; })
                return options.batch;
            else
                return views_of(method).batch;
        },
        method);
}

bool is_papers(const MethodOptions& method)
{
    return std::visit(
        [](const auto& options) {
            if constexpr (requires { options.iteration; })
                return options.iteration.scheme == Scheme::paper;
            else if constexpr (requires { options.scheme; })
                return options.scheme == Scheme::paper;
            else
                return false;
        },
        method);
}

}  // namespace lumel
