// The legend of false colours, with a mark at the value under the mouse.

import { colourAt } from './colours.js';

const bar = { top: 8, height: 14 }, gap = 6; // [CSS pixels]

export class Legend {
    constructor(canvas, scale) {
        this.canvas = canvas;
        this.scale = scale;
        new ResizeObserver(() => this.draw()).observe(canvas);
    }

    /** Shows another scale. */
    show(scale) {
        this.scale = scale;
        this.draw();
    }

    /** reading: light and error to mark, the one that the scale is for. */
    draw(reading = {}) {
        const { clientWidth: width, clientHeight: height } = this.canvas;
        const ratio = window.devicePixelRatio;
        this.canvas.width = width * ratio;
        this.canvas.height = height * ratio;
        const context = this.canvas.getContext('2d');
        context.scale(ratio, ratio);
        for (let x = 0; x < width; ++x) {
            context.fillStyle = `rgb(${colourAt(x / width)})`;
            context.fillRect(x, bar.top, 1, bar.height);
        }
        context.fillStyle = getComputedStyle(this.canvas).color;
        context.font = '12px system-ui, sans-serif';
        let free = 0; // minimum position of the next number
        for (const value of this.scale.ticks()) {
            const x = this.scale.placeOf(value) * width, text = this.scale.text(value);
            const long = context.measureText(text).width;
            const left = Math.min(Math.max(x - long / 2, 0), width - long);
            context.fillRect(x, bar.top + bar.height, 1, 4);
            if (left < free) continue;
            context.fillText(text, left, height - 4);
            free = left + long + gap;
        }
        const read = reading[this.scale.quantity];
        if (read > 0) this.mark(context, Math.min(Math.max(this.scale.placeOf(read), 0), 1) * width);
    }

    mark(context, x) {
        context.beginPath();
        context.moveTo(x - 5, 0);
        context.lineTo(x + 5, 0);
        context.lineTo(x, bar.top + 4);
        context.fill();
    }
}
