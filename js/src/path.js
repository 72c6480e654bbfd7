// What is drawn, as the text of an SVG path, or as a polygon.

export class Path {
    #text = "";
    #start = null;

    moveTo(x, y) {
        this.#start = [+x, +y];
        this.#text += `M${+x},${+y}`;
    }

    lineTo(x, y) {
        this.#text += `L${+x},${+y}`;
    }

    closePath() {
        if (this.#start !== null) this.#text += "Z";
    }

    /** A whole circle, which is what points are drawn as. */
    arc(x, y, radius) {
        const r = +radius;
        const [left, right] = [+x - r, +x + r];
        if (this.#start === null) this.#text += `M${right},${+y}`;
        if (r > 0) this.#text += `A${r},${r},0,1,1,${left},${+y}A${r},${r},0,1,1,${right},${+y}`;
    }

    rect(x, y, width, height) {
        this.#text += `M${+x},${+y}h${+width}v${+height}h${-width}Z`;
        this.#start = [+x, +y];
    }

    /** The text; null if nothing has been drawn. */
    value() {
        return this.#text || null;
    }
}

/** Draws to a context, or to a path if there is none, whose text it then gives. */
export function drawn(context, draw) {
    if (context != null) {
        draw(context);
        return undefined;
    }
    const path = new Path();
    draw(path);
    return path.value();
}

/** Draws a closed polygon of contiguous coordinates. */
export function drawPolygon(context, coordinates) {
    context.moveTo(coordinates[0], coordinates[1]);
    for (let k = 2; k < coordinates.length; k += 2) context.lineTo(coordinates[k], coordinates[k + 1]);
    context.closePath();
}

/** A closed polygon as points, of which the first one is also the last. */
export function closed(coordinates) {
    const points = [];
    for (let k = 0; k < coordinates.length; k += 2) points.push([coordinates[k], coordinates[k + 1]]);
    points.push([coordinates[0], coordinates[1]]);
    return points;
}
