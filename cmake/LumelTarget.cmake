# The rooms and who may use whom, ground floor first; tools/lint holds every #include to the same table.
set(LUMEL_ROOM_TABLE ${PROJECT_SOURCE_DIR}/src/rooms.txt)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${LUMEL_ROOM_TABLE})

# lumel_wings(<result>): the wings of src, the folders that the rooms lie in, ground floor first.
function(lumel_wings result)
    file(STRINGS ${LUMEL_ROOM_TABLE} wings REGEX "^src/")
    list(TRANSFORM wings REPLACE "^src/([a-z]+)[/:].*" "\\1")
    list(REMOVE_DUPLICATES wings)
    set(${result} ${wings} PARENT_SCOPE)
endfunction()

# lumel_uses(<wing> <result>): the wings that its rooms use, and lumel for the public interface.
function(lumel_uses wing result)
    file(STRINGS ${LUMEL_ROOM_TABLE} uses REGEX "^src/${wing}[/:]")
    list(TRANSFORM uses REPLACE "^[^:]*: *" "")
    list(JOIN uses " " uses)
    separate_arguments(uses)
    list(TRANSFORM uses REPLACE "/.*" "")
    list(REMOVE_DUPLICATES uses)
    list(REMOVE_ITEM uses ${wing})
    set(${result} ${uses} PARENT_SCOPE)
endfunction()

# lumel_wing(<name> SOURCES … SYSTEM <library> …): the rooms of one wing of src as one static library.
function(lumel_wing name)
    cmake_parse_arguments(WING "" "" "SOURCES;SYSTEM" ${ARGN})
    add_library(lumel_${name} STATIC ${WING_SOURCES})
    lumel_flags(lumel_${name})
    lumel_joint(lumel_${name})
    lumel_uses(${name} used)
    list(TRANSFORM used PREPEND lumel_)
    target_link_libraries(lumel_${name} PUBLIC ${used} PRIVATE ${WING_SYSTEM})
endfunction()

# Seconds that each test took when `./test --record` ran last: ctest starts the longest first.
set(LUMEL_DURATIONS ${PROJECT_SOURCE_DIR}/tests/durations.txt)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${LUMEL_DURATIONS})
file(STRINGS ${LUMEL_DURATIONS} lines REGEX "^[^#]")
foreach(line ${lines})
    string(REPLACE " " ";" line "${line}")
    list(GET line 0 name)
    list(GET line 1 LUMEL_SECONDS_${name})
endforeach()

# lumel_test(<name> [LABEL <label>] SOURCES … USES <wing> … [PARTS "<part> <label> <filter>" …]
#            [UNDER <command> <argument> …] [JOINT] [SANITIZE]):
# one GoogleTest program under tests/ and what ctest runs of it. A part is the tests of a filter
# (that of --gtest_filter) in a process of their own; what no part has is one more, of the program's name.
# UNDER: what ctest runs the program by. JOINT: has many sources, which are compiled jointly.
# SANITIZE: `./test --sanitize` runs what is not slow of it.
# Labels: `quick` ends in a minute with all others of its kind, `normal`, and `slow`.
function(lumel_test name)
    cmake_parse_arguments(TEST "JOINT;SANITIZE" "LABEL" "SOURCES;USES;SYSTEM;PARTS;UNDER" ${ARGN})
    add_executable(${name} ${TEST_SOURCES})
    lumel_flags(${name} HEADERS lumel_test_headers)
    if(TEST_JOINT)
        lumel_joint(${name})
    endif()
    list(TRANSFORM TEST_USES PREPEND lumel_)
    target_link_libraries(${name} PRIVATE ${TEST_USES} ${TEST_SYSTEM} lumel_test_support
                                          GTest::gtest GTest::gtest_main)
    set(rest "*-")
    foreach(part ${TEST_PARTS})
        string(REGEX MATCH "^([^ ]+) ([a-z]+) (.+)$" matched "${part}")
        set(filter ${CMAKE_MATCH_3})
        set(labels ${CMAKE_MATCH_2})
        if(TEST_SANITIZE AND NOT labels STREQUAL slow)
            list(APPEND labels sanitize)
        endif()
        lumel_test_entry(${name}.${CMAKE_MATCH_1} "${labels}" ${name} --gtest_filter=${filter}
                         UNDER ${TEST_UNDER})
        string(APPEND rest ":${filter}")
    endforeach()
    set(labels normal)
    if(TEST_LABEL)
        set(labels ${TEST_LABEL})
    endif()
    if(TEST_SANITIZE)
        list(APPEND labels sanitize)
    endif()
    lumel_test_entry(${name} "${labels}" ${name} --gtest_filter=${rest} UNDER ${TEST_UNDER})
    if(TEST_SANITIZE)
        add_dependencies(sanitize_tests ${name})
    endif()
    list(TRANSFORM TEST_SOURCES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE sources)
    list(JOIN sources " " sources)
    set_property(GLOBAL APPEND PROPERTY LUMEL_TEST_PROGRAMS "${name} $<TARGET_FILE:${name}> ${sources}")
endfunction()

# lumel_test_entry(<name> <labels> <program> <argument> … [UNDER <command> …]): what ctest runs. ./test limits
# processor time; the limit here, by the clock, is for what hangs.
function(lumel_test_entry name labels program)
    cmake_parse_arguments(ENTRY "" "" "UNDER" ${ARGN})
    if(ENTRY_UNDER)
        list(APPEND ENTRY_UNDER $<TARGET_FILE:${program}>)
    else()
        set(ENTRY_UNDER ${program})
    endif()
    add_test(NAME ${name} COMMAND ${ENTRY_UNDER} ${ENTRY_UNPARSED_ARGUMENTS})
    set_tests_properties(${name} PROPERTIES LABELS "${labels}" TIMEOUT 7200
                         FAIL_REGULAR_EXPRESSION "Running 0 tests")
    if(DEFINED LUMEL_SECONDS_${name})
        set_tests_properties(${name} PROPERTIES COST ${LUMEL_SECONDS_${name}})
    endif()
    if("quick" IN_LIST labels)
        add_dependencies(quick_tests ${program})
    endif()
endfunction()
