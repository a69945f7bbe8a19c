# cmake -DCOMPILER=<c++> "-DFLAGS=<flag;…>" -DSOURCE=<wrong_bindings.cpp> -P wrong_bindings.cmake
# The source compiles as it is, and with WRONG = 1, 2, … fails at the kernel's call.

set(command ${COMPILER} -std=c++20 -fsyntax-only ${FLAGS})
execute_process(COMMAND ${command} ${SOURCE} RESULT_VARIABLE failed ERROR_VARIABLE why)
if(failed)
    message(FATAL_ERROR "What is right does not compile:\n${why}")
endif()
foreach(wrong RANGE 1 5)
    execute_process(COMMAND ${command} -DWRONG=${wrong} ${SOURCE}
                    RESULT_VARIABLE failed ERROR_VARIABLE why)
    if(NOT failed)
        message(FATAL_ERROR "What is wrong compiles: WRONG=${wrong}")
    endif()
    if(NOT why MATCHES "Weigh::(Bindings|Params)|WeighParams")
        message(FATAL_ERROR "WRONG=${wrong} fails for another reason:\n${why}")
    endif()
endforeach()
