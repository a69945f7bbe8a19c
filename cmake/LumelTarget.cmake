# lumel_room(<name> SOURCES … USES <room or target> …): one folder of src as one static library.
# A room sees only the rooms it names, so a wrong include does not compile into a program.

function(lumel_room name)
    cmake_parse_arguments(ROOM "" "" "SOURCES;USES;SYSTEM" ${ARGN})
    add_library(lumel_${name} STATIC ${ROOM_SOURCES})
    lumel_flags(lumel_${name})
    foreach(used ${ROOM_USES})
        target_link_libraries(lumel_${name} PUBLIC lumel_${used})
    endforeach()
    target_link_libraries(lumel_${name} PRIVATE ${ROOM_SYSTEM})
endfunction()

# lumel_test(<name> [TOGETHER] SOURCES … USES <room> …): one GoogleTest program under tests/. Each of its
# tests is a process of its own; TOGETHER: one for all, where they share what takes long to make.
function(lumel_test name)
    cmake_parse_arguments(TEST "TOGETHER" "" "SOURCES;USES;SYSTEM" ${ARGN})
    add_executable(${name} ${TEST_SOURCES})
    lumel_flags(${name} HEADERS lumel_test_headers)
    foreach(used ${TEST_USES})
        target_link_libraries(${name} PRIVATE lumel_${used})
    endforeach()
    target_link_libraries(${name} PRIVATE ${TEST_SYSTEM} lumel_test_support GTest::gtest GTest::gtest_main)
    if(TEST_TOGETHER)
        add_test(NAME ${name} COMMAND ${name})
        # The longest test begins first, or a processor idles while it ends.
        set_tests_properties(${name} PROPERTIES TIMEOUT 1500 COST 1500)
    else()
        gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 900)
    endif()
endfunction()
