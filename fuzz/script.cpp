#include "viewer/session/script.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "readers.h"

namespace lumel::fuzz {

void read_script(Input input)
{
    const std::string text(input.begin(), input.end());
    int line = 0;
    for (const ScriptCommand& command : lumel::read_script(text, "script")) {
        require(command.line > line, "lines rise");
        line = command.line;
        require(command.numbers.size() <= command.form->numbers.most,
                "no more numbers than a form takes");
        require(std::all_of(command.numbers.begin(), command.numbers.end(),
                            [](double number) { return std::isfinite(number); }),
                "numbers are finite");
    }
}

}  // namespace lumel::fuzz
