/// What a device has time for, by the time that its frames take.

/// Frames that wait for the device.
const mostInFlight = 2;
/// The first frames after a change take part in compiling, or in what was there before ...
const firstFrames = 3;
/// ... and so many say what the device can do.
const framesToKnow = 8;
/// How much of the mean time of frames the newest one is.
const newest = 0.1;
/// Widths for "automatic" [pixels]: the first one, unless frames take less or more time than these [ms].
const firstWidth = 480;
const fast = { frameTime: 20, width: 960 };
const slow = { frameTime: 400, width: 320 };
/// Devices that take less time for a frame have a reference with less noise and more code [ms].
const referenceFrameTime = 100;
/// On others, it waits until nothing has moved for so long [ms] ...
const rest = 300;
/// ... and gets a frame of so many.
const referenceShare = 4;

export interface FrameWork {
    /// How many images it draws.
    readonly images: number;
    /// Whether a program draws for the first time.
    readonly compiles: boolean;
}

/// Times are in ms. Only frames that draw images count: while all programs are compiled, frames take no time.
export class Pacing {
    /// The width that "automatic" stands for [pixels].
    width = firstWidth;
    private inFlight = 0;
    private compiling = 0;
    private isWidthChosen = false;
    /// Frames since the last change or program.
    private begun = 0;
    private ended = 0;
    private lastChange = -Infinity;
    private lastEnd = 0;
    private mean = 0;

    /// Whether the device may be compiling: it does nothing else then.
    get isCompiling(): boolean { return this.compiling > 0; }

    /// Whether the next frame can begin.
    get isFree(): boolean { return !this.isCompiling && this.inFlight < mostInFlight; }

    /// The mean time of a frame, 0 where it is not known yet.
    get frameTime(): number { return this.ended > firstFrames ? this.mean : 0; }

    get isFast(): boolean { return this.mean < referenceFrameTime; }

    /// Something else is to be seen.
    change(now: number): void {
        this.lastChange = now;
        this.begun = this.ended = 0;
    }

    /// Whether a reference may add up in this frame.
    /// \param isIdle whether there is nothing else to draw
    allowsReference(now: number, isIdle: boolean): boolean {
        if (now - this.lastChange <= rest) return false;
        return isIdle || (this.ended >= framesToKnow && (this.isFast || this.begun % referenceShare === 0));
    }

    begin(work: FrameWork): void {
        ++this.inFlight;
        if (work.images > 0) ++this.begun;
        if (work.compiles) {
            ++this.compiling;
            this.ended = 0;
        }
    }

    /// \param work    of begin()
    /// \param chooses whether the width is to be chosen
    /// \returns whether another width is better
    end(now: number, work: FrameWork, chooses: boolean): boolean {
        --this.inFlight;
        if (work.compiles) --this.compiling;
        const interval = now - this.lastEnd;
        this.lastEnd = now;
        if (work.images === 0) return false;
        if (++this.ended > firstFrames)
            this.mean = this.ended < framesToKnow ? interval : (1 - newest) * this.mean + newest * interval;
        if (!chooses || this.isWidthChosen || this.ended < framesToKnow) return false;
        this.isWidthChosen = true;
        const before = this.width;
        this.width = this.mean < fast.frameTime ? fast.width : this.mean > slow.frameTime ? slow.width : firstWidth;
        return this.width !== before;
    }
}
