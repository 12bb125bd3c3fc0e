/// Halton's sequence.

/// The radical inverse of a number.
export function halton(index: number, base: number): number {
    let result = 0;
    for (let digit = 1 / base; index > 0; digit /= base) {
        result += digit * (index % base);
        index = Math.floor(index / base);
    }
    return result;
}
