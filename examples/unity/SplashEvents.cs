// SPDX-License-Identifier: MIT
// Put this on any object: what happens in the water are events on Unity's main thread.
using System;
using UnityEngine;

public struct SplashEvent
{
    public int Body;          // its number in the scene, -1: none
    public float Speed;       // of an impact [m/s]
    public float Radius;      // of a bubble or cavity [m]
    public Vector3 Place;     // in Unity's axes [m]
    public float Delay;       // until it sounds [s]
}

public class SplashEvents : MonoBehaviour
{
    public string Host = "127.0.0.1";
    public int Port = 57300;

    public event Action<SplashEvent> Impact, Bubble, Cavity;

    SplashSocket socket;
    float frameDelay;

    void OnEnable() { socket = new SplashSocket(Host, Port, true); }

    void OnDisable() { socket.Dispose(); }

    void Update()
    {
        SplashMessage message;
        while (socket.Take(out message)) Tell(message);
    }

    void Tell(SplashMessage message)
    {
        // Later versions may add arguments, never take any away.
        switch (message.Address)
        {
            case "/frame": frameDelay = message.Number(3) / 1000; break;
            case "/impact": Call(Impact, At(message, 4, 7), e => { e.Speed = message.Number(2); return e; }); break;
            case "/bubble": Call(Bubble, At(message, 4, 7), e => { e.Radius = message.Number(2); return e; }); break;
            case "/cavity": Call(Cavity, At(message, 4, 7), e => { e.Radius = message.Number(2); return e; }); break;
        }
    }

    SplashEvent At(SplashMessage message, int place, int offset)
    {
        float x, y, z;
        SplashOsc.ToUnity(message.Number(place), message.Number(place + 1), message.Number(place + 2),
                          out x, out y, out z);
        return new SplashEvent
        {
            Body = (int)message.Number(1),
            Place = new Vector3(x, y, z),
            Delay = Math.Max(0, frameDelay + message.Number(offset) / 1000)
        };
    }

    static void Call(Action<SplashEvent> told, SplashEvent happened, Func<SplashEvent, SplashEvent> fill)
    {
        if (told != null) told(fill(happened));
    }
}
