#!/usr/bin/env python3
"""Writes a weather file of a made year in Budapest, half of its days clear and half grey.

    made_weather.py FILE.epw

For trying and timing `lumel measure --weather`: no place has this weather. Standard library only.
"""

import math
import random
import sys

LATITUDE, LONGITUDE, ZONE = 47.5, 19.0, 1.0
DAYS = (31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31)
HEADER = f"""LOCATION,Made,-,-,made,0,{LATITUDE},{LONGITUDE},{ZONE},100
DESIGN CONDITIONS,0
TYPICAL/EXTREME PERIODS,0
GROUND TEMPERATURES,0
HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0
COMMENTS 1,made by made_weather.py
COMMENTS 2,
DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31
"""
LOWEST = 0.02  # sine of the sun's elevation, from which on there is light


def sine_of_sun(day, hour):
    """Of the sun's elevation in the middle of an hour of local time, to a degree or two."""
    declination = math.radians(23.44) * math.sin(2 * math.pi * (day - 81) / 365)
    angle = math.radians(15 * (hour - 0.5 - ZONE + LONGITUDE / 15 - 12))
    latitude = math.radians(LATITUDE)
    return (math.sin(latitude) * math.sin(declination)
            + math.cos(latitude) * math.cos(declination) * math.cos(angle))


def radiation(sine, cloud):
    """Direct normal and diffuse horizontal [W/m²]."""
    if sine <= LOWEST:
        return 0, 0
    if cloud < 0.5:
        return round(1100 * math.exp(-0.25 / sine) * (1 - cloud)), round(60 + 90 * sine)
    return 0, round(350 * sine * (1.2 - cloud) + 20)


def main():
    chance = random.Random(1)
    text, day_of_year = HEADER, 0
    for month, days in enumerate(DAYS, 1):
        for day in range(1, days + 1):
            day_of_year += 1
            cloud = chance.random()
            for hour in range(1, 25):
                direct, diffuse = radiation(sine_of_sun(day_of_year, hour), cloud)
                text += (f"2001,{month},{day},{hour},0,?9,15.0,8.0,70,101325,0,0,300,0,{direct},{diffuse},"
                         "999999,999999,999999,9999,180,3.0,5,5,20.0,77777,9,999999999,200,0.1,0,88,0.2,0,0\n")
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write(text)


main()
