#include "solve/options.h"

namespace lumel {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

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
        Overloaded{[](const MatrixOptions& options) { return options.transport.views; },
                   [](const auto& options) {
                       if constexpr (requires { options.views; })
                           return options.views;
                       else
                           return ViewOptions{};
                   }},
        method);
}

int batch_of(const MethodOptions& method)
{
    return std::visit(
        Overloaded{[](const MatrixOptions& options) { return options.transport.views.batch; },
                   [](const auto& options) {
                       if constexpr (requires { options.views; })
                           return options.views.batch;
                       else
                           return options.batch;
                   }},
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
